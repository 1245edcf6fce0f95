#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/mpe/players/exec_player.h>
#include <folk/mpe/world/random_stream.h>
#include <folk/strategies/programs/child_process.h>
#include <folk/strategies/programs/exec_player.h>
#include <folk/strategies/quoted_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace folk::mpe {
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
      child_->send("end\n", std::min(time_out_, ChildProcess::grace));
    } catch (const EnvironmentError&) {
      child_->abandon();  // the episodes are over, and so is the program
    }
  }

  void start(const Layout& layout, const Block&, std::size_t agent, const Moment& moment) override {
    if (!child_) child_ = std::make_unique<ChildProcess>(name_, command_);
    unsent_ = fmt::format("episode {} agent={} steps={} seed={}\n", layout.scenario().name, agent,
                          layout.scenario().episode_steps,
                          random_stream(moment.seed, RandomUse::predators, moment.first, 0, agent)());
  }

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    if (!child_) start(layout, block, agent, moment);
    std::string line = unsent_ + "act";
    for (std::size_t row = layout.observation_begin(agent); row < layout.observation_begin(agent + 1); ++row)
      line += fmt::format(" {}", block.observations[row * block_lanes]);
    unsent_.clear();
    const auto force = ask(line + "\n");
    const auto [x, y] = action_rows(block, agent);
    *x = force.x;
    *y = force.y;
  }

private:
  Force ask(const std::string& lines) {
    try {
      // An answer to an earlier line would be taken for the answer to this one, and all later ones would be off by one.
      if (child_->has_spoken())
        throw EnvironmentError(name_ + ": wrote a line before it was asked; only the line 'act' wants an answer");
      child_->send(lines, time_out_);
      const std::string answer = child_->receive(time_out_);
      try {
        return parse_force(answer);
      } catch (const UsageError& error) {
        throw EnvironmentError(fmt::format("{}: {}", name_, error.what()));
      }
    } catch (const EnvironmentError&) {
      child_->abandon();
      child_.reset();
      throw;
    }
  }

  std::string name_;
  std::string command_;
  milliseconds time_out_;
  std::unique_ptr<ChildProcess> child_;
  std::string unsent_;
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

Controller exec_controller(std::string_view command, milliseconds time_out) {
  const std::string plain = unquoted(command);
  const std::string name = exec_strategy(plain, time_out).name;  // of the same form, and refused for the same reasons
  return {name, each([=](const Layout&, std::size_t) { return std::make_unique<ExecPlayer>(name, plain, time_out); }),
          true};
}

}  // namespace folk::mpe
