#include <folk/games/error.h>
#include <folk/mpe/players/transformer_player.h>
#include <folk/mpe/world/aligned_doubles.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace folk::mpe {
namespace {

/// Episodes that are thought through together: what their tokens take fits the cache.
constexpr std::size_t group_episodes = 16;

/// What the three predators share: whoever is asked first in a step thinks for all.
class Predators {
public:
  Predators(std::shared_ptr<const TransformerMind> mind, const TransformerPlay& play, const Layout& layout)
      : mind_(std::move(mind)),
        play_(play),
        target_(play.target.value_or(mind_->policy.return_target)) {
    if (play.prey) shadow_ = play.prey->team(layout, Side::prey);
  }

  void start(const Layout& layout, const Block& block, const Moment& moment) {
    next_step_ = 0;
    const std::size_t groups = (block.lanes + group_episodes - 1) / group_episodes;
    if (lanes_ != block.lanes) {
      lanes_ = block.lanes;
      thinkers_.clear();
      for (std::size_t g = 0; g < groups; ++g)
        thinkers_.push_back(std::make_unique<TransformerThinker>(
            *mind_, std::min(group_episodes, lanes_ - g * group_episodes), target_));
    }
    for (auto& thinker : thinkers_) thinker->restart();
    if (!shadow_.empty()) shadow_.front()->start(layout, block, layout.scenario().prey(), moment);
  }

  /// The actions of this step [lanes, predators * 2].
  const Matrix<float>& actions(const Layout& layout, const Block& block, const Moment& moment) {
    if (next_step_ == moment.step + 1) return actions_;
    next_step_ = moment.step + 1;
    look(layout, block, moment);
    const Index agents = index(layout.scenario().predators());
    actions_.resize(index(lanes_), 2 * agents);
    const Matrix<float> forced = forced_beliefs(layout, block, moment);
    for (std::size_t g = 0; g < thinkers_.size(); ++g) {
      const std::size_t begin = g * group_episodes;
      const std::size_t count = std::min(group_episodes, lanes_ - begin);
      auto& thinker = *thinkers_[g];
      const Matrix<float> beliefs = thinker.see(std::span(glimpses_).subspan(begin, count));
      auto actions = actions_.middleRows(index(begin), index(count));
      actions = thinker.act(beliefs);
      Matrix<float> free;
      if (forced.size() > 0) {
        free = actions;
        actions = thinker.act(forced.middleRows(index(begin), index(count)));
      }
      if (!play_.witness) continue;
      for (Index e = 0; e < index(count); ++e) {
        ThoughtRecord thought{
            moment.first + begin + static_cast<std::size_t>(e), moment.step, {beliefs(e, 0), beliefs(e, 1)}, 0};
        for (Index i = 0; forced.size() > 0 && i < agents; ++i)
          thought.change += std::hypot(static_cast<double>(actions(e, 2 * i) - free(e, 2 * i)),
                                       static_cast<double>(actions(e, 2 * i + 1) - free(e, 2 * i + 1))) /
                            static_cast<double>(agents);
        play_.witness(thought);
      }
    }
    return actions_;
  }

private:
  /// What the block shows: observations of now, and what was done and earned in the step before.
  void look(const Layout& layout, const Block& block, const Moment& moment) {
    const std::size_t prey = layout.scenario().prey();
    const std::size_t width = layout.observation_begin(prey);  // of all predators, who come first
    const std::size_t own = 2 * prey;
    const bool first = moment.step == 0;
    seen_.resize(lanes_ * (width + own + 2));
    glimpses_.clear();
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      float* numbers = seen_.data() + lane * (width + own + 2);
      for (std::size_t k = 0; k < width; ++k)
        numbers[k] = static_cast<float>(block.observations[k * block_lanes + lane]);
      for (std::size_t k = 0; k < own + 2; ++k)
        numbers[width + k] = first ? 0.0F : static_cast<float>(block.actions[k * block_lanes + lane]);
      glimpses_.push_back({std::span(numbers, width), first ? 0.0F : static_cast<float>(block.rewards[lane]),
                           std::span<const float, 2>(numbers + width + own, 2), std::span(numbers + width, own)});
    }
  }

  /// [lanes, 2], or nothing where nothing is forced.
  Matrix<float> forced_beliefs(const Layout& layout, const Block& block, const Moment& moment) {
    if (play_.forcing == BeliefForcing::none) return {};
    Matrix<float> forced = Matrix<float>::Zero(index(lanes_), 2);
    if (play_.forcing == BeliefForcing::zero) return forced;
    const std::size_t prey = layout.scenario().prey();
    Block shadow = block;
    shadow_actions_.assign(block.actions, block.actions + layout.action_rows() * block_lanes);
    shadow.actions = shadow_actions_.data();
    shadow_.front()->act(layout, shadow, prey, moment);
    const auto [x, y] = action_rows(shadow, prey);
    const std::size_t shift = play_.forcing == BeliefForcing::other_episode ? 1 : 0;
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      const std::size_t from = (lane + shift) % lanes_;
      forced(index(lane), 0) = static_cast<float>(x[from]);
      forced(index(lane), 1) = static_cast<float>(y[from]);
    }
    return forced;
  }

  std::shared_ptr<const TransformerMind> mind_;
  TransformerPlay play_;
  double target_;
  Team shadow_;
  std::size_t lanes_ = 0;
  std::size_t next_step_ = 0;
  std::vector<std::unique_ptr<TransformerThinker>> thinkers_;
  std::vector<float> seen_;
  std::vector<Glimpse> glimpses_;
  AlignedDoubles shadow_actions_;
  Matrix<float> actions_;
};

class TransformerPlayer final : public Player {
public:
  explicit TransformerPlayer(std::shared_ptr<Predators> predators)
      : predators_(std::move(predators)) {}

  void start(const Layout& layout, const Block& block, std::size_t, const Moment& moment) override {
    predators_->start(layout, block, moment);
  }

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    const auto& actions = predators_->actions(layout, block, moment);
    const auto [x, y] = action_rows(block, agent);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      x[lane] = static_cast<double>(actions(index(lane), 2 * index(agent)));
      y[lane] = static_cast<double>(actions(index(lane), 2 * index(agent) + 1));
    }
  }

private:
  std::shared_ptr<Predators> predators_;
};

}  // namespace

std::string_view to_string(BeliefForcing forcing) {
  switch (forcing) {
    case BeliefForcing::none: return "none";
    case BeliefForcing::truth: return "truth";
    case BeliefForcing::other_episode: return "other-episode";
    case BeliefForcing::zero: return "zero";
  }
  return "?";
}

Controller transformer_controller(std::string name, std::shared_ptr<const TransformerMind> mind,
                                  const Scenario& scenario, TransformerPlay play) {
  if (mind->policy.scenario != scenario.name)
    throw UsageError(
        fmt::format("{}: a policy for {}, not for {}", excerpt(name, 1000), mind->policy.scenario, scenario.name));
  if (play.forcing != BeliefForcing::none && !mind->acts_on_belief())
    throw UsageError(
        fmt::format("{}: its actions do not look at the belief token: there is nothing to force", excerpt(name, 1000)));
  const bool foresees = play.forcing == BeliefForcing::truth || play.forcing == BeliefForcing::other_episode;
  if (foresees && (!play.prey || play.prey->one_by_one))
    throw UsageError(fmt::format("{}: to force beliefs by what the prey will do, the prey must be a player of Folk",
                                 excerpt(name, 1000)));
  if (!foresees) play.prey.reset();
  const auto make = [mind = std::move(mind), play = std::move(play)](const Layout& layout, Side side) {
    if (side == Side::prey) throw UsageError("a transformer plays the predators, not the prey");
    const auto shared = std::make_shared<Predators>(mind, play, layout);
    Team team;
    for (std::size_t i = 0; i < agents_of(layout, side).size(); ++i)
      team.push_back(std::make_unique<TransformerPlayer>(shared));
    return team;
  };
  return {std::move(name), make};
}

}  // namespace folk::mpe
