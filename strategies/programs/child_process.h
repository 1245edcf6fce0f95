#pragma once
// A shell command that runs beside us, with lines of text in both directions.

#include <folk/games/file_descriptor.h>
#include <folk/strategies/programs/keeper.h>

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace folk {

/// `/bin/sh -c COMMAND` with its stdin and stdout on pipes of ours; stderr is shared with ours.
///
/// Safe to use from many threads, one thread a child: nothing leaks into another child (close-on-exec throughout),
/// nothing runs between fork and exec, and the process's signal handling is left as it is.
/// The child leads a process group of its own, which is gone when the object is, and what it has started with it; so it
/// is when our process dies, in whatever way.
class ChildProcess {
public:
  /// A line of the child may have this many bytes, its end not counted.
  static constexpr std::size_t longest_line = 4096;

  /// `name` is what messages call the child, `question` the line that wants an answer. Throws EnvironmentError when no
  /// process can be started.
  ChildProcess(std::string name, const std::string& command, std::string question = "move");

  /// Closes the child's stdin, waits `grace` unless the child was abandoned, and kills what is left of it, its process
  /// group and what it has started.
  ~ChildProcess();

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Writes whole lines. Throws EnvironmentError when the child ended or does not take them in `time_out`.
  void send(std::string_view lines, std::chrono::milliseconds time_out);

  /// The next line, without its end. Throws EnvironmentError when the child ended, when the line is not whole in
  /// `time_out` (the message ends with `hint` then), or when it is longer than longest_line.
  std::string receive(std::chrono::milliseconds time_out, std::string_view hint = {});

  /// True when the child has written something that was not received yet. Throws EnvironmentError when it ended.
  bool has_spoken() { return speaks_within(std::chrono::milliseconds(0)); }

  /// True when it has, or does so in this time. Throws EnvironmentError when it ends.
  bool speaks_within(std::chrono::milliseconds time);

  /// Writes the last lines, closes the child's stdin, and waits for the end of its output or `grace`: true when it has
  /// written something that was not received.
  bool end(std::string_view lines, std::chrono::milliseconds time_out);

  /// From its start to its first line; 0 before it.
  std::chrono::milliseconds first_answer_took() const { return first_answer_took_; }

  /// The longest time between lines that were sent and a later line of its own, the first not counted.
  std::chrono::milliseconds slowest_answer() const { return slowest_answer_; }

  /// Leaves the destructor nothing to wait for.
  void abandon() { abandoned_ = true; }

  /// What the destructor allows the child to end by itself.
  static constexpr std::chrono::milliseconds grace{1000};

private:
  bool read_some();
  void note_answer();
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_ended() const;
  bool wait_for_end(std::chrono::milliseconds limit) const;

  std::string name_;
  std::string question_;
  pid_t id_ = -1;
  std::optional<Kept> kept_;
  FileDescriptor to_child_;
  FileDescriptor from_child_;
  std::string received_;
  std::chrono::nanoseconds began_{};  // on a steady clock
  std::chrono::nanoseconds asked_{};
  bool has_answered_ = false;
  std::chrono::milliseconds first_answer_took_{0};
  std::chrono::milliseconds slowest_answer_{0};
  bool abandoned_ = false;
};

}  // namespace folk
