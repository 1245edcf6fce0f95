#pragma once
// A program on a pipe that is told lines and asked questions: what players of all worlds have in common.

#include <folk/games/error.h>
#include <folk/strategies/programs/child_process.h>
#include <folk/strategies/programs/idle_programs.h>
#include <folk/strategies/programs/program_rules.h>

#include <memory>
#include <string>
#include <string_view>

namespace folk {

/// Runs the program of a call from the first question on. After any failure it begins anew with a fresh one.
class AskedProgram {
public:
  /// `question` is the word that wants an answer, as messages name it: "move". `idle` holds programs of the same call
  /// that wait; what took long to start goes there at the end and comes from there.
  AskedProgram(ProgramCall call, std::string question, std::shared_ptr<IdlePrograms> idle = nullptr);

  /// Tells the program "end", unless finish did, and lets it go.
  ~AskedProgram();

  AskedProgram(const AskedProgram&) = delete;
  AskedProgram& operator=(const AskedProgram&) = delete;

  /// Starts the program unless it runs. Throws EnvironmentError when it cannot be started, and when one that waited has
  /// spoken unasked meanwhile.
  void run();
  bool runs() const { return child_ != nullptr; }

  /// A line that wants no answer; it is sent with the next question: one message a round, not two.
  void tell(std::string_view line);

  /// parse(the answer to this line). Throws EnvironmentError, naming the program, when it has spoken unasked, ends, is
  /// silent for too long, or parse throws UsageError.
  template <class Parse>
  auto ask(std::string_view line, const Parse& parse) {
    try {
      try {
        return parse(answer(line));
      } catch (const UsageError& error) {
        throw EnvironmentError(name_ + ": " + error.what());
      }
    } catch (const EnvironmentError&) {
      drop();
      throw;
    }
  }

  /// Tells the program "end" and waits for its end, or leaves one that took long to start to the next player: then it
  /// is only waited whether it says more. Throws EnvironmentError when it has written more than it was asked for.
  void finish();

private:
  std::string answer(std::string_view line);
  void drop();
  bool is_to_wait() const;
  void leave_to_the_next();
  [[noreturn]] void fail_for_more_lines() const;

  ProgramCall call_;
  std::string name_;
  std::string question_;
  std::unique_ptr<ChildProcess> child_;
  bool has_answered_ = false;
  std::shared_ptr<IdlePrograms> idle_;
  std::string unsent_;
};

}  // namespace folk
