#include <folk/strategies/programs/asked_program.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace folk {

AskedProgram::AskedProgram(ProgramCall call, std::string question)
    : call_(std::move(call)),
      name_(to_string(call_)),
      question_(std::move(question)) {}

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
  child_ = std::make_unique<ChildProcess>(name_, call_.command, question_);
  has_answered_ = false;
  unsent_.clear();
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
  const auto child = std::exchange(child_, nullptr);
  if (child->end(std::exchange(unsent_, {}) + "end\n", call_.rules.answer)) {
    child->abandon();
    throw EnvironmentError(fmt::format("{}: wrote more lines than it was asked for; only the line '{}' wants an answer",
                                       name_, question_));
  }
}

void AskedProgram::drop() {
  if (child_) child_->abandon();
  child_.reset();
}

}  // namespace folk
