#include <folk/analysis/play/parallel.h>
#include <folk/sct/data/recorded_play.h>
#include <folk/sct/policy/belief_effect.h>
#include <folk/sct/policy/sct_player.h>

namespace folk::sct {
namespace {

Move greedy(const Thought& thought) { return likelier_move(thought.cooperation); }

BeliefEffect effect_in(const Trajectory& match, const Mind& mind) {
  const auto& training = mind.policy.training;
  Thinker thinker(mind);
  MatchSoFar so_far = begin_match(training.return_target / training.return_scale);
  BeliefEffect effect;
  for (std::size_t t = 0; t < match.rounds(); ++t) {
    const auto thought = thinker.think(so_far);
    if (mind.policy.architecture.belief_token) {
      effect.changed_by_c += greedy(thinker.think(so_far, 0)) != match.own[t] ? 1U : 0U;
      effect.changed_by_d += greedy(thinker.think(so_far, 1)) != match.own[t] ? 1U : 0U;
    }
    add_round(so_far, match.own[t], match.theirs[t], likelier_move(thought.belief),
              match.rewards[t] / training.return_scale);
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
