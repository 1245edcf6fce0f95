#include <folk/games/error.h>
#include <folk/strategies/programs/child_process.h>
#include <folk/strategies/programs/pipes.h>
#include <folk/strategies/programs/program_rules.h>
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
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace folk {

namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

[[noreturn]] void fail_to_start(const std::string& name, const std::error_code& error) {
  throw EnvironmentError(
      fmt::format("{}: cannot be started: {}; fewer programs at once may help", name, error.message()));
}

/// Each end of a pipe has its own flags: the child's ends stay blocking.
void set_non_blocking(const FileDescriptor& descriptor) {
  ::fcntl(descriptor.get(), F_SETFL, ::fcntl(descriptor.get(), F_GETFL) | O_NONBLOCK);
}

/// The processes that this one has started and that are still its own.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  std::error_code error;
  for (std::filesystem::directory_iterator task(fmt::format("/proc/{}/task", parent), error), end;
       !error && task != end; task.increment(error)) {
    std::ifstream list(task->path() / "children");
    for (pid_t child = 0; list >> child;) children.push_back(child);
  }
  return children;
}

/// Kills a process, its group, and whatever it has started that went into another.
void kill_all(pid_t leader) {
  std::vector<pid_t> all{leader};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const pid_t child : children_of(all[i])) all.push_back(child);
  ::kill(-leader, SIGKILL);
  for (const pid_t id : all) ::kill(id, SIGKILL);
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

ChildProcess::ChildProcess(std::string name, const std::string& command, std::string question)
    : name_(std::move(name)),
      question_(std::move(question)),
      began_(Clock::now().time_since_epoch()) {
  try {
    Pipe input = open_pipe();
    Pipe output = open_pipe();
    const StandardStreams streams{input.read_end.get(), output.write_end.get(), StandardStreams::shared};
    if (const auto error = spawn(id_, {"/bin/sh", "-c", command}, streams, ProcessGroup::own))
      throw std::system_error(error);
    kept_.emplace(id_);
    to_child_ = std::move(input.write_end);
    from_child_ = std::move(output.read_end);
  } catch (const std::system_error& error) {
    fail_to_start(name_, error.code());
  }
  set_non_blocking(to_child_);
  set_non_blocking(from_child_);
}

ChildProcess::~ChildProcess() {
  to_child_.close();
  if (!abandoned_) wait_for_end(grace);
  // An ended leader is not reaped yet, so that its number still means this group and no newer one.
  kill_all(id_);
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ChildProcess::send(std::string_view lines, milliseconds time_out) {
  asked_ = Clock::now().time_since_epoch();
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

std::string ChildProcess::receive(milliseconds time_out, std::string_view hint) {
  const auto deadline = Clock::now() + time_out;
  for (;;) {
    const auto end = received_.find('\n');
    if (std::min(end, received_.size()) > longest_line)
      fail(fmt::format("wrote a line of more than {} bytes; an answer is one short line", longest_line));
    if (end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      note_answer();
      return line;
    }
    if (!ready(from_child_, POLLIN, deadline))
      fail(fmt::format("silent for {} s; it must answer each '{}' with one line, and flush its output{}",
                       seconds(time_out), question_, hint));
    if (!read_some()) fail_ended();
  }
}

void ChildProcess::note_answer() {
  const auto now = Clock::now().time_since_epoch();
  if (std::exchange(has_answered_, true))
    slowest_answer_ = std::max(slowest_answer_, std::chrono::ceil<milliseconds>(now - asked_));
  else
    first_answer_took_ = std::chrono::floor<milliseconds>(now - began_);
}

bool ChildProcess::end(std::string_view lines, milliseconds time_out) {
  const auto deadline = Clock::now() + grace;
  try {
    send(lines, std::min(time_out, grace));
  } catch (const EnvironmentError&) {
    abandoned_ = true;  // it has gone, or does not listen: it was not to do anything more
  }
  to_child_.close();
  while (received_.empty()) {
    if (!ready(from_child_, POLLIN, deadline)) {
      abandoned_ = true;
      break;
    }
    if (!read_some()) break;
  }
  return !received_.empty();
}

bool ChildProcess::speaks_within(milliseconds time) {
  const auto deadline = Clock::now() + time;
  while (received_.empty() && ready(from_child_, POLLIN, deadline))
    if (!read_some()) fail_ended();
  return !received_.empty();
}

/// False at the end of the child's output.
bool ChildProcess::read_some() {
  std::array<char, longest_line> block;
  const ssize_t count = ::read(from_child_.get(), block.data(), block.size());
  if (count > 0) received_.append(block.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
}

void ChildProcess::fail(const std::string& what) const {
  throw EnvironmentError(fmt::format("{}: {}", excerpt(name_, 1000), what));
}

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
