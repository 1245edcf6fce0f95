#include <folk/analysis/equilibria/pair_examination.h>
#include <folk/analysis/equilibria/prepared_pair.h>
#include <folk/analysis/play/joint_play.h>
#include <folk/analysis/play/pair_player.h>

#include <algorithm>
#include <memory>

namespace folk {
namespace {

double payoff_of(const OutcomeWeights& weights, const Payoffs& payoffs, bool exchanged) {
  const auto numbers = payoffs.numbers();
  double sum = 0;
  for (const Outcome outcome : all_outcomes)
    sum += weights[outcome.index()] * numbers[(exchanged ? outcome.exchanged() : outcome).index()];
  return sum;
}

/// Every situation that two machines that mix or slip come into with positive probability; the first are listed.
void list_states(const PreparedPair& pair, PairExamination& found) {
  const Noise noise = pair.first().rules().noise;
  const JointPlay play(pair.first().table(), pair.second().table(),
                       noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own);
  found.all_states = play.size();
  for (std::size_t s = 0; s < std::min(play.size(), most_listed_states); ++s)
    found.states.push_back({play.history_to(s), really_played(play.first_cooperation(s), noise)[0],
                            really_played(play.second_cooperation(s), noise)[0]});
}

Strategy played(Strategy strategy, std::shared_ptr<const Machine> machine) {
  strategy.machine = std::move(machine);
  return strategy;
}

}  // namespace

PairExamination examine_machines(const ExaminationQuestion& question, const Strategy& opponent, ClassReplies& beliefs,
                                 const Progress& progress) {
  PreparedMachine& own = beliefs.machines().of(question.policy.machine);
  PreparedMachine& theirs = beliefs.machines().of(opponent.machine);
  const PreparedPair pair(own, theirs, question.horizon);
  PairExamination found;
  found.opponent = opponent.name;
  found.gaps = pair_gaps(pair, beliefs, progress.part(0, 0.5));
  const PairResult result = play_pair(played(question.policy, own.player(question.horizon)),
                                      played(opponent, theirs.player(question.horizon)), question.sampling());
  found.own_score = payoff_of(result.weights, question.payoffs, false);
  found.their_score = payoff_of(result.weights, question.payoffs, true);
  found.method = result.method;
  found.path = pair.path();
  if (!found.path)
    list_states(pair, found);
  else if (own.whole() && theirs.whole() && flint_available())
    found.thresholds =
        thresholds(*own.whole(), *theirs.whole(), question.payoffs, question.sides, {}, progress.part(0.5, 1));
  found.verdicts = judge_all(found.gaps, question.sides, question.epsilon_payoff);
  return found;
}

}  // namespace folk
