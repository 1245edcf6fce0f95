#include <folk/analysis/replies/better_move.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/sct/policy/planner.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk::sct {
namespace {

double certain(Move move) { return move == Move::C ? 1 : 0; }

/// What is remembered of the observations `seen` once one more round is played.
std::vector<std::uint8_t> continued(const std::vector<std::uint8_t>& seen, Outcome played, std::size_t remembered) {
  const std::size_t kept = std::min(seen.size(), remembered - 1);
  std::vector<std::uint8_t> after(seen.end() - static_cast<std::ptrdiff_t>(kept), seen.end());
  after.push_back(observation_of(played.own, played.theirs));
  return after;
}

}  // namespace

Planner::Planner(const Mind& mind, const PlanSettings& settings)
    : mind_(mind),
      settings_(settings),
      heads_(mind.policy.architecture, mind.network.layout(), {mind.policy.architecture.observation_token(0)}),
      branches_(mind.network, mind.policy.parameters.data()) {
  if (settings.depth == 0 || settings.depth > most_plan_depth)
    throw UsageError(fmt::format("a plan of {} rounds, expected 1 to {}", settings.depth, most_plan_depth));
}

Plan Planner::plan(Thinker& thinker, const MatchSoFar& so_far, const std::array<double, 4>& payoffs, unsigned left,
                   std::optional<ForcedBelief> forced) {
  Plan plan;
  plan.belief = thinker.believe(so_far);
  const double present = forced ? certain(forced->move) : plan.belief;
  levels_.assign(1, Level{Situation{present, so_far.returns.back(), so_far.observations}});
  const Thinker::Present now = thinker.present();
  branches_.begin(now.stream, now.tokens);
  const unsigned depth = std::clamp(left, 1U, settings_.depth);
  while (levels_.size() < depth) look_further(so_far.own.size() + levels_.size(), payoffs, forced);
  plan.situations = 0;
  for (const Level& level : levels_) plan.situations += level.size();

  std::vector<double> next;
  for (std::size_t l = levels_.size(); l-- > 0;) {
    std::vector<double> best;
    for (const Situation& situation : levels_[l]) {
      plan.values = values(situation, next, payoffs);
      best.push_back(std::max(plan.values[0], plan.values[1]));
    }
    next = std::move(best);
  }
  return plan;
}

/// Adds the level of the situations before `round` (rounds count from 0).
void Planner::look_further(std::size_t round, const std::array<double, 4>& payoffs,
                           std::optional<ForcedBelief> forced) {
  Level& before = levels_.back();
  Level after;
  std::vector<std::size_t> parents, outcomes;
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t o = 0; o < 4; ++o) {
      const double probability = o % 2 == 0 ? before[i].belief : 1 - before[i].belief;
      if (probability < settings_.least_probability) continue;
      before[i].next[o] = after.size();
      after.push_back({0.5, before[i].asked - static_cast<float>(mind_.return_token(payoffs[o])),
                       continued(before[i].seen, all_outcomes[o], mind_.remembered())});
      parents.push_back(i);
      outcomes.push_back(o);
    }
  const Matrix<float>& hidden = branches_.grow(tokens(round, outcomes, after), parents);
  Matrix<float> logits;
  heads_.belief(mind_.policy.parameters.data(), hidden, logits);
  for (std::size_t i = 0; i < after.size(); ++i)
    after[i].belief = forced && forced->throughout ? certain(forced->move) : first_class(logits, index(i));
  levels_.push_back(std::move(after));
}

/// What a situation adds to the one before it: the moves of the round that was played, and the return and observation
/// of the present one, embedded.
Matrix<float> Planner::tokens(std::size_t round, const std::vector<std::size_t>& outcomes,
                              const Level& situations) const {
  const auto& architecture = mind_.policy.architecture;
  Batch<float> batch;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome played = all_outcomes[outcomes[i]];
    for (const std::size_t t : {round - 1, round}) {
      batch.returns.push_back(situations[i].asked);
      const auto& seen = situations[i].seen;
      append_observations(seen, seen.size() - 1, mind_.remembered(), batch.observations);
      batch.timesteps.push_back(architecture.time_row(t));
      batch.opponent.classes.push_back(static_cast<std::int32_t>(bit(played.theirs)));
      batch.own.classes.push_back(static_cast<std::int32_t>(bit(played.own)));
    }
    batch.window_rounds.push_back(2);
  }
  EmbeddingTape<float> tape;
  Matrix<float> embedded;
  embed_tokens(mind_, batch, tape, embedded);
  // From the token behind the first round's observation to the second round's observation.
  const Index all = index(architecture.round_tokens());
  const Index first = index(architecture.observation_token(0)) + 1;
  Matrix<float> added(index(outcomes.size()) * all, embedded.cols());
  for (Index i = 0; i < index(outcomes.size()); ++i)
    added.middleRows(i * all, all) = embedded.middleRows(2 * i * all + first, all);
  return added;
}

std::array<double, 2> Planner::values(const Situation& situation, const std::vector<double>& next,
                                      const std::array<double, 4>& payoffs) const {
  std::array<double, 2> values{};
  for (std::size_t own = 0; own < 2; ++own) {
    double followed = 0, later = 0;
    for (std::size_t theirs = 0; theirs < 2; ++theirs) {
      const double probability = theirs == 0 ? situation.belief : 1 - situation.belief;
      const std::size_t outcome = 2 * own + theirs;
      values[own] += probability * payoffs[outcome];
      if (situation.next[outcome] == none) continue;
      followed += probability;
      later += probability * next[situation.next[outcome]];
    }
    if (followed > 0) values[own] += settings_.continuation * later / followed;
  }
  return values;
}

Move Plan::better() const {
  constexpr double network_rounding = 1e-5;  // single precision, layer upon layer
  return better_move(values, network_rounding);
}

}  // namespace folk::sct
