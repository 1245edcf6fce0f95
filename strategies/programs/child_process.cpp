#include <folk/games/error.h>
#include <folk/strategies/programs/child_process.h>
#include <folk/strategies/programs/spawn.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <system_error>
#include <thread>
#include <utility>

namespace folk {

namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

double seconds(milliseconds time) { return std::chrono::duration<double>(time).count(); }

struct Pipe {
  FileDescriptor read_end;
  FileDescriptor write_end;
};

[[noreturn]] void fail_to_start(const std::string& name, const std::error_code& error) {
  throw EnvironmentError(
      fmt::format("{}: cannot be started: {}; fewer programs at once may help", name, error.message()));
}

/// A pipe that takes the place of a standard stream which the host closed would receive what the host writes there.
FileDescriptor above_standard(FileDescriptor descriptor) {
  return descriptor.get() > STDERR_FILENO ? std::move(descriptor) : duplicate_above_standard(descriptor.get());
}

/// Close-on-exec from birth: otherwise a child started by another thread keeps the ends open and nobody sees their end.
Pipe open_pipe(const std::string& name) {
  int ends[2];
  const bool opened = ::pipe2(ends, O_CLOEXEC) == 0;
  Pipe pipe;
  if (opened) pipe = {above_standard(FileDescriptor(ends[0])), above_standard(FileDescriptor(ends[1]))};
  if (!opened || pipe.read_end.get() < 0 || pipe.write_end.get() < 0)
    fail_to_start(name, std::error_code(errno, std::generic_category()));
  return pipe;
}

/// Each end of a pipe has its own flags: the child's ends stay blocking.
void set_non_blocking(const FileDescriptor& descriptor) {
  ::fcntl(descriptor.get(), F_SETFL, ::fcntl(descriptor.get(), F_GETFL) | O_NONBLOCK);
}

/// Waits until `events` are possible (or the other end is gone); false when the deadline passes first.
bool ready(const FileDescriptor& descriptor, short events, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
    pollfd wait{descriptor.get(), events, 0};
    const int found = ::poll(&wait, 1, static_cast<int>(std::max<milliseconds::rep>(left.count(), 0)));
    if (found > 0) return true;
    if (found == 0 && left.count() <= 0) return false;
    if (found < 0 && errno != EINTR) return true;  // the read or write that follows says what is wrong
  }
}

/// write(2) to a pipe whose reader may be gone, without the SIGPIPE that would end the host: blocked for this thread
/// only, and taken off again when it was ours.
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

std::string describe_end(const siginfo_t& end) {
  constexpr auto mend = "in the middle of a match; it must read and answer until the line 'end'";
  if (end.si_code != CLD_EXITED) {
    const char* name = ::sigabbrev_np(end.si_status);
    return name != nullptr ? fmt::format("was killed by SIG{} {}", name, mend)
                           : fmt::format("was killed by signal {} {}", end.si_status, mend);
  }
  switch (end.si_status) {
    case 127: return "ended with exit status 127: the shell found no such command; check its name and path";
    case 126: return "ended with exit status 126: the shell may not execute it; check its permissions";
    default: return fmt::format("ended with exit status {} {}", end.si_status, mend);
  }
}

}  // namespace

ChildProcess::ChildProcess(std::string name, const std::string& command)
    : name_(std::move(name)) {
  Pipe input = open_pipe(name_);
  Pipe output = open_pipe(name_);
  const StandardStreams streams{input.read_end.get(), output.write_end.get(), StandardStreams::shared};
  if (const auto error = spawn(id_, {"/bin/sh", "-c", command}, streams, ProcessGroup::own))
    fail_to_start(name_, error);
  to_child_ = std::move(input.write_end);
  from_child_ = std::move(output.read_end);
  set_non_blocking(to_child_);
  set_non_blocking(from_child_);
}

ChildProcess::~ChildProcess() {
  to_child_.close();
  if (!abandoned_) wait_for_end(grace);
  // An ended leader is not reaped yet, so that its number still means this group and no newer one.
  ::kill(-id_, SIGKILL);
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ChildProcess::send(std::string_view lines, milliseconds time_out) {
  const auto deadline = Clock::now() + time_out;
  while (!lines.empty()) {
    const ssize_t written = write_without_signal(to_child_, lines);
    if (written >= 0)
      lines.remove_prefix(static_cast<std::size_t>(written));
    else if (errno == EAGAIN) {
      if (!ready(to_child_, POLLOUT, deadline))
        fail(fmt::format("read nothing for {} s; it must read every line of its input", seconds(time_out)));
    } else if (errno != EINTR) {
      fail_ended();
    }
  }
}

std::string ChildProcess::receive(milliseconds time_out) {
  const auto deadline = Clock::now() + time_out;
  for (;;) {
    const auto end = received_.find('\n');
    if (std::min(end, received_.size()) > longest_line)
      fail(fmt::format("wrote a line of more than {} bytes; an answer is one short line", longest_line));
    if (end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    if (!ready(from_child_, POLLIN, deadline))
      fail(fmt::format("silent for {} s; it must answer each 'move' with one line, and flush its output",
                       seconds(time_out)));
    if (!read_some()) fail_ended();
  }
}

bool ChildProcess::has_spoken() {
  if (received_.empty() && ready(from_child_, POLLIN, Clock::now()) && !read_some()) fail_ended();
  return !received_.empty();
}

/// False at the end of the child's output.
bool ChildProcess::read_some() {
  std::array<char, longest_line> block;
  const ssize_t count = ::read(from_child_.get(), block.data(), block.size());
  if (count > 0) received_.append(block.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
}

void ChildProcess::fail(const std::string& what) const { throw EnvironmentError(fmt::format("{}: {}", name_, what)); }

void ChildProcess::fail_ended() const {
  siginfo_t end{};
  if (!wait_for_end(grace) || ::waitid(P_PID, static_cast<id_t>(id_), &end, WEXITED | WNOHANG | WNOWAIT) != 0)
    fail("closed its input or output in the middle of a match; it must read and answer until the line 'end'");
  fail(describe_end(end));
}

/// True when the child ended; it is left to be reaped.
bool ChildProcess::wait_for_end(milliseconds limit) const {
  const auto deadline = Clock::now() + limit;
  for (auto pause = std::chrono::microseconds(50);; pause = std::min(2 * pause, std::chrono::microseconds(5000))) {
    siginfo_t end{};
    const int result = ::waitid(P_PID, static_cast<id_t>(id_), &end, WEXITED | WNOHANG | WNOWAIT);
    if (result < 0 && errno != EINTR) return true;  // somebody else has reaped it
    if (result == 0 && end.si_pid == id_) return true;
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace folk
