#include <folk/games/error.h>
#include <folk/strategies/programs/asked_program.h>
#include <folk/strategies/programs/exec_player.h>

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace folk {

namespace {

class ExecPlayer final : public Player {
public:
  ExecPlayer(ProgramCall call, std::shared_ptr<IdlePrograms> idle)
      : program_(std::move(call), "move", std::move(idle)) {}

  void start(const MatchStart& match) override {
    program_.run();
    belief_.reset();
    program_.tell(fmt::format("game {} criterion={} seed={}", to_text(match.payoffs), match.criterion.to_string(),
                              RandomStream(match.random)()));
  }

  Move move() override {
    const Reply reply = program_.ask("move", parse_reply);
    belief_ = reply.belief;
    return reply.move;
  }

  void observe(Move own, Move theirs) override {
    program_.tell(fmt::format("round {} {}", to_char(own), to_char(theirs)));
  }

  std::optional<double> belief() const override { return belief_; }

  void finish() override { program_.finish(); }

private:
  AskedProgram program_;
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

Strategy exec_strategy(ProgramCall call) {
  check_call(call);
  Strategy strategy{to_string(call), nullptr,
                    [call, idle = std::make_shared<IdlePrograms>()]() -> std::unique_ptr<Player> {
                      return std::make_unique<ExecPlayer>(call, idle);
                    }};
  strategy.deterministic = call.rules.deterministic;
  return strategy;
}

}  // namespace folk
