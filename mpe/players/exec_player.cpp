#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/mpe/players/exec_player.h>
#include <folk/mpe/world/random_stream.h>
#include <folk/strategies/programs/asked_program.h>

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace folk::mpe {
namespace {

class ExecPlayer final : public Player {
public:
  ExecPlayer(ProgramCall call, std::shared_ptr<IdlePrograms> idle)
      : program_(std::move(call), "act", std::move(idle)) {}

  void start(const Layout& layout, const Block&, std::size_t agent, const Moment& moment) override {
    program_.run();
    program_.tell(fmt::format("episode {} agent={} steps={} seed={}", layout.scenario().name, agent,
                              layout.scenario().episode_steps,
                              random_stream(moment.seed, RandomUse::predators, moment.first, 0, agent)()));
  }

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    if (!program_.runs()) start(layout, block, agent, moment);
    std::string line = "act";
    for (std::size_t row = layout.observation_begin(agent); row < layout.observation_begin(agent + 1); ++row)
      line += fmt::format(" {}", block.observations[row * block_lanes]);
    const Force force = program_.ask(line, parse_force);
    const auto [x, y] = action_rows(block, agent);
    *x = force.x;
    *y = force.y;
  }

  void finish() override { program_.finish(); }

private:
  AskedProgram program_;
};

}  // namespace

Force parse_force(std::string_view line) {
  const auto end = line.find_last_not_of(" \t\r");
  const std::string_view text = line.substr(0, end + 1);  // npos + 1 is 0
  const auto blank = text.find_first_of(" \t");
  const auto second = text.find_first_not_of(" \t", blank);
  try {
    if (blank != std::string_view::npos && second != std::string_view::npos)
      return {parse_number(text.substr(0, blank), "x", -1e6, 1e6), parse_number(text.substr(second), "y", -1e6, 1e6)};
  } catch (const UsageError&) {
  }
  throw UsageError(fmt::format("answer '{}': expected an action, two numbers as in '0.5 -1'", excerpt(line)));
}

Controller exec_controller(const ProgramCall& call) {
  check_call(call);
  const auto idle = std::make_shared<IdlePrograms>();
  return {to_string(call),
          each([call, idle](const Layout&, std::size_t) { return std::make_unique<ExecPlayer>(call, idle); }), true};
}

}  // namespace folk::mpe
