#include <folk/strategies/programs/pipes.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <system_error>
#include <utility>

namespace folk {
namespace {

/// A pipe that takes the place of a standard stream which the host closed would receive what the host writes there.
FileDescriptor above_standard(FileDescriptor descriptor) {
  return descriptor.get() > STDERR_FILENO ? std::move(descriptor) : duplicate_above_standard(descriptor.get());
}

}  // namespace

Pipe open_pipe() {
  int ends[2];
  const bool opened = ::pipe2(ends, O_CLOEXEC) == 0;
  Pipe pipe;
  if (opened) pipe = {above_standard(FileDescriptor(ends[0])), above_standard(FileDescriptor(ends[1]))};
  if (!opened || pipe.read_end.get() < 0 || pipe.write_end.get() < 0)
    throw std::system_error(errno, std::generic_category());
  return pipe;
}

bool ready(const FileDescriptor& descriptor, short events, std::chrono::steady_clock::time_point deadline) {
  using std::chrono::milliseconds;
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd wait{descriptor.get(), events, 0};
    const int found = ::poll(&wait, 1, static_cast<int>(std::max<milliseconds::rep>(left.count(), 0)));
    if (found > 0) return true;
    if (found == 0 && left.count() <= 0) return false;
    if (found < 0 && errno != EINTR) return true;  // the read or write that follows says what is wrong
  }
}

ssize_t write_without_signal(const FileDescriptor& descriptor, std::string_view text) {
  sigset_t pipe_signal;
  sigset_t before;
  sigset_t pending;
  sigemptyset(&pipe_signal);
  sigaddset(&pipe_signal, SIGPIPE);
  ::sigpending(&pending);
  ::pthread_sigmask(SIG_BLOCK, &pipe_signal, &before);
  const ssize_t written = ::write(descriptor.get(), text.data(), text.size());
  const int error = errno;
  if (written < 0 && error == EPIPE && sigismember(&pending, SIGPIPE) == 0) {
    const timespec at_once{};
    while (::sigtimedwait(&pipe_signal, nullptr, &at_once) < 0 && errno == EINTR) {
    }
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return written;
}

}  // namespace folk
