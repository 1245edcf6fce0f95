#include <folk/analysis/play/parallel.h>
#include <folk/sct/data/recorded_play.h>
#include <folk/sct/policy/belief_effect.h>
#include <folk/sct/policy/planner.h>
#include <folk/sct/policy/sct_player.h>

#include <algorithm>
#include <optional>

namespace folk::sct {
namespace {

/// The moves of a policy in one match, by its action head or by its plans.
class Mover {
public:
  explicit Mover(const Mind& mind)
      : mind_(mind),
        thinker_(mind) {
    const auto& training = mind.policy.training;
    if (training.plan_depth > 0) planner_.emplace(mind, PlanSettings{.depth = training.plan_depth});
  }

  struct Act {
    double belief;
    Move move;
  };

  Act operator()(const MatchSoFar& so_far, std::optional<ForcedBelief> forced = std::nullopt) {
    const auto& training = mind_.policy.training;
    if (!planner_) {
      const auto thought = thinker_.think(so_far, forced ? std::optional(forced->move) : std::nullopt);
      return {thought.belief, likelier_move(thought.cooperation)};
    }
    const std::uint64_t left = training.rounds - so_far.own.size();
    const auto plan = planner_->plan(thinker_, so_far, training.payoffs.numbers(),
                                     static_cast<unsigned>(std::min<std::uint64_t>(left, most_plan_depth)), forced);
    return {plan.belief, plan.better()};
  }

private:
  const Mind& mind_;
  Thinker thinker_;
  std::optional<Planner> planner_;
};

BeliefEffect effect_in(const Trajectory& match, const Mind& mind) {
  const auto& training = mind.policy.training;
  Mover mover(mind);
  MatchSoFar so_far = begin_match(mind.return_token(training.return_target));
  BeliefEffect effect;
  for (std::size_t t = 0; t < match.rounds(); ++t) {
    const auto acted = mover(so_far);
    if (mind.policy.architecture.belief_token) {
      const auto changed = [&](Move move, bool throughout) {
        return mover(so_far, ForcedBelief{move, throughout}).move != match.own[t] ? 1U : 0U;
      };
      effect.changed_by_c += changed(Move::C, true);
      effect.changed_by_d += changed(Move::D, true);
      effect.present_by_c += changed(Move::C, false);
      effect.present_by_d += changed(Move::D, false);
    }
    add_round(so_far, match.own[t], match.theirs[t], likelier_move(acted.belief), mind.return_token(match.rewards[t]));
    ++effect.rounds;
  }
  return effect;
}

}  // namespace

std::vector<BeliefEffect> belief_effects(const std::shared_ptr<const Mind>& mind, const std::vector<Strategy>& roster,
                                         unsigned threads, const Progress& progress) {
  const auto& training = mind->policy.training;
  const auto matches = play_and_record(transformer("policy", mind), roster, training.payoffs, training.rounds, 0, 1,
                                       training.seed, threads);
  progress(0.5);
  std::vector<BeliefEffect> effects(matches.size());
  const auto measure = [&](std::size_t i, unsigned) { effects[i] = effect_in(matches[i], *mind); };
  parallel_for(matches.size(), threads, measure, progress.part(0.5, 1));
  return effects;
}

BeliefEffect belief_effect(const std::shared_ptr<const Mind>& mind, const std::vector<Strategy>& roster,
                           unsigned threads, const Progress& progress) {
  BeliefEffect sum;
  for (const auto& effect : belief_effects(mind, roster, threads, progress)) sum += effect;
  return sum;
}

}  // namespace folk::sct
