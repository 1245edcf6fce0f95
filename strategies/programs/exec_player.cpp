#include <folk/games/error.h>
#include <folk/strategies/programs/child_process.h>
#include <folk/strategies/programs/exec_player.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace folk {

namespace {

using std::chrono::milliseconds;

class ExecPlayer final : public Player {
public:
  ExecPlayer(std::string name, std::string command, milliseconds time_out)
      : name_(std::move(name)),
        command_(std::move(command)),
        time_out_(time_out) {}

  ~ExecPlayer() override {
    if (!child_) return;
    try {
      child_->send(unsent_ + "end\n", std::min(time_out_, ChildProcess::grace));
    } catch (const EnvironmentError&) {
      child_->abandon();  // the match is over, and so is the program
    }
  }

  void start(const MatchStart& match) override {
    if (!child_) {
      child_ = std::make_unique<ChildProcess>(name_, command_);
      unsent_.clear();
    }
    belief_.reset();
    unsent_ += fmt::format("game {} criterion={} seed={}\n", to_text(match.payoffs), match.criterion.to_string(),
                           RandomStream(match.random)());
  }

  Move move() override {
    if (!child_) throw std::logic_error("a player is asked for a move before its match has started");
    try {
      return ask();
    } catch (const EnvironmentError&) {
      child_->abandon();
      child_.reset();
      throw;
    }
  }

  // Sent with the next line that wants an answer: one message a round, not two.
  void observe(Move own, Move theirs) override {
    unsent_ += fmt::format("round {} {}\n", to_char(own), to_char(theirs));
  }

  std::optional<double> belief() const override { return belief_; }

private:
  Move ask() {
    // An answer to an earlier line would be taken for the answer to this one, and all later ones would be off by one.
    if (child_->has_spoken())
      throw EnvironmentError(name_ + ": wrote a line before it was asked; only the line 'move' wants an answer");
    child_->send(unsent_ + "move\n", time_out_);
    unsent_.clear();
    const std::string line = child_->receive(time_out_);
    try {
      const Reply reply = parse_reply(line);
      belief_ = reply.belief;
      return reply.move;
    } catch (const UsageError& error) {
      throw EnvironmentError(fmt::format("{}: {}", name_, error.what()));
    }
  }

  std::string name_;
  std::string command_;
  milliseconds time_out_;
  std::unique_ptr<ChildProcess> child_;
  std::string unsent_;
  std::optional<double> belief_;
};

std::string_view without_blanks_behind(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

}  // namespace

Reply parse_reply(std::string_view line) {
  const auto refuse = [&] {
    return UsageError(
        fmt::format("answer '{}': expected C or D, then perhaps P(opponent plays C), as in 'C 0.85'", excerpt(line)));
  };
  const std::string_view text = without_blanks_behind(line);
  if (text.empty() || (text[0] != 'C' && text[0] != 'D')) throw refuse();
  Reply reply{text[0] == 'C' ? Move::C : Move::D, std::nullopt};
  if (text.size() == 1) return reply;
  const auto number = text.find_first_not_of(" \t", 1);
  if (number == 1 || number == std::string_view::npos) throw refuse();
  try {
    reply.belief = parse_number(text.substr(number), "belief", 0, 1);
  } catch (const UsageError&) {
    throw refuse();
  }
  return reply;
}

Strategy exec_strategy(const std::string& command, milliseconds time_out) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (command.find_first_not_of(' ') == std::string::npos)
    throw UsageError("exec: has no command; write exec:\"COMMAND\", as in exec:\"python3 player.py\"");
  if (std::any_of(command.begin(), command.end(), is_control))
    throw UsageError(fmt::format("exec: command '{}' has control characters; put it into a script", excerpt(command)));
  if (time_out < milliseconds(1) || time_out > std::chrono::hours(24))
    throw UsageError(fmt::format("exec: time-out of {} ms: expected 1 ms to a day", time_out.count()));
  std::string escaped;  // so that the registry reads the name back to the same command
  for (const char c : command) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  const std::string name = fmt::format("exec:\"{}\"", escaped);
  return {name, nullptr,
          [=]() -> std::unique_ptr<Player> { return std::make_unique<ExecPlayer>(name, command, time_out); }};
}

}  // namespace folk
