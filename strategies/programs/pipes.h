#pragma once
// Pipes to other programs.

#include <folk/games/file_descriptor.h>

#include <sys/types.h>

#include <chrono>
#include <string_view>

namespace folk {

struct Pipe {
  FileDescriptor read_end;
  FileDescriptor write_end;
};

/// Close-on-exec from birth: otherwise a child started by another thread keeps the ends open and nobody sees their end.
/// Both are above the standard streams, which the host may have closed. Throws std::system_error.
Pipe open_pipe();

/// Waits until `events` are possible (or the other end is gone); false when the deadline passes first.
bool ready(const FileDescriptor& descriptor, short events, std::chrono::steady_clock::time_point deadline);

/// write(2) to a pipe whose reader may be gone, without the SIGPIPE that would end the host: blocked for this thread
/// only, and taken off again when it was ours.
ssize_t write_without_signal(const FileDescriptor& descriptor, std::string_view text);

}  // namespace folk
