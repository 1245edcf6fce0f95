#pragma once
// Starting another program beside us.

#include <sys/types.h>

#include <string>
#include <system_error>
#include <vector>

namespace folk {

/// The descriptors of ours that a program gets as its stdin, stdout and stderr. They stay open here.
struct StandardStreams {
  /// The program has the stream that we have.
  static constexpr int shared = -1;

  int input = shared;
  int output = shared;
  int error = shared;
};

/// `ours`: a Ctrl-C at the terminal ends the program too. `own`: it leads a group that can be killed as a whole.
enum class ProcessGroup { ours, own };

/// Starts `argv` (the program is looked up on PATH unless its name has a slash; no shell is involved) and sets `id`.
/// Returns why it could not be started: std::errc::no_such_file_or_directory when there is no such program.
///
/// Safe to use from many threads: nothing of ours runs between fork and exec. The program begins with no signal blocked
/// and with the usual end by SIGPIPE and SIGXFSZ, whatever the host set. Of our other descriptors it inherits those
/// that are not close-on-exec. The streams may be any descriptors, 0, 1 and 2 in another order too.
[[nodiscard]] std::error_code spawn(pid_t& id, const std::vector<std::string>& argv, const StandardStreams& streams,
                                    ProcessGroup group);

}  // namespace folk
