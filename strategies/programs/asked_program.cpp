#include <folk/strategies/programs/asked_program.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

using std::chrono::milliseconds;

/// How long a program that goes on to the next player is heard out, at least: one that is an answer behind all the time
/// has yet to give its last.
constexpr milliseconds hearing{250};

}  // namespace

AskedProgram::AskedProgram(ProgramCall call, std::string question, std::shared_ptr<IdlePrograms> idle)
    : call_(std::move(call)),
      name_(excerpt(to_string(call_), 1000)),
      question_(std::move(question)),
      idle_(std::move(idle)) {}

AskedProgram::~AskedProgram() {
  if (!child_) return;
  try {
    child_->send(unsent_ + "end\n", std::min(call_.rules.answer, ChildProcess::grace));
  } catch (const EnvironmentError&) {
    child_->abandon();  // nothing more is asked, and the program is gone
  }
}

void AskedProgram::run() {
  if (child_) return;
  unsent_.clear();
  if (idle_) child_ = idle_->take();
  has_answered_ = child_ != nullptr;
  if (child_) {
    if (!child_->has_spoken()) return;
    drop();
    fail_for_more_lines();
  }
  child_ = std::make_unique<ChildProcess>(name_, call_.command, question_);
}

void AskedProgram::tell(std::string_view line) {
  unsent_ += line;
  unsent_ += '\n';
}

std::string AskedProgram::answer(std::string_view line) {
  if (!child_) throw std::logic_error("a program is asked before it was started");
  // An answer to an earlier line would be taken for the answer to this one, and all later ones would be off by one.
  if (child_->has_spoken())
    throw EnvironmentError(
        fmt::format("{}: wrote a line before it was asked; only the line '{}' wants an answer", name_, question_));
  tell(line);
  const auto limit = has_answered_ ? call_.rules.answer : call_.rules.first_answer;
  child_->send(std::exchange(unsent_, {}), limit);
  std::string text =
      child_->receive(limit, has_answered_ ? "" : "; exec(\"CMD\";start=SECONDS) gives it longer to start");
  has_answered_ = true;
  return text;
}

void AskedProgram::finish() {
  if (!child_) return;
  if (is_to_wait()) {
    leave_to_the_next();
    return;
  }
  const auto child = std::exchange(child_, nullptr);
  if (child->end(std::exchange(unsent_, {}) + "end\n", call_.rules.answer)) {
    child->abandon();
    fail_for_more_lines();
  }
}

bool AskedProgram::is_to_wait() const {
  return idle_ && has_answered_ && child_->first_answer_took() >= idle_->worth_keeping();
}

void AskedProgram::leave_to_the_next() {
  auto child = std::exchange(child_, nullptr);
  bool more = false;
  try {
    child->send(std::exchange(unsent_, {}), std::min(call_.rules.answer, ChildProcess::grace));
    more = child->speaks_within(std::clamp(2 * child->slowest_answer(), hearing, ChildProcess::grace));
  } catch (const EnvironmentError&) {
    child->abandon();  // it has gone, or does not listen: it was not to do anything more
    return;
  }
  if (!more) return idle_->give(std::move(child));
  child->abandon();
  fail_for_more_lines();
}

void AskedProgram::fail_for_more_lines() const {
  throw EnvironmentError(
      fmt::format("{}: wrote more lines than it was asked for; only the line '{}' wants an answer", name_, question_));
}

void AskedProgram::drop() {
  if (child_) child_->abandon();
  child_.reset();
}

}  // namespace folk
