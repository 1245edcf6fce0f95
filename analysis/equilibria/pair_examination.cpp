#include <folk/analysis/equilibria/continuation.h>
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

/// From the first round on. The beliefs of the two sides may be one object.
PairExamination examine_whole(const ExaminationQuestion& question, const Strategy& opponent, ClassReplies& beliefs,
                              ClassReplies& their_beliefs, const Progress& progress) {
  PreparedMachine& own = beliefs.machines().of(question.policy.machine);
  PreparedMachine& theirs = beliefs.machines().of(opponent.machine);
  const PreparedPair pair(own, theirs, question.horizon);
  PairExamination found;
  found.opponent = opponent.name;
  found.gaps = pair_gaps(pair, beliefs, their_beliefs, progress.part(0, 0.5));
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
  return found;
}

PairExamination examine_from(const ExaminationQuestion& question, const Strategy& opponent, const Progress& progress) {
  const auto before = first_rounds_of(*question.policy.machine, *opponent.machine, question.from - 1);
  const Continuation later(question, opponent, before);
  ClassReplies beliefs = class_replies(later.question);
  ClassReplies their_beliefs = class_replies(later.their_question());
  PairExamination found = examine_whole(later.question, later.opponent, beliefs, their_beliefs, progress);
  put_before(before, found);
  return found;
}

void put_before_deviations(const std::vector<Outcome>& before, SideGaps& gaps) {
  for (auto* gap : {&gaps.nash, &gaps.subgame_perfect, &gaps.self_confirming_unrestricted, &gaps.self_confirming_class})
    if (*gap && (*gap)->witness.deviation) {
      auto& history = (*gap)->witness.history;
      history.insert(history.begin(), before.begin(), before.end());
    }
}

}  // namespace

PairExamination examine_machines(const ExaminationQuestion& question, const Strategy& opponent, ClassReplies& beliefs,
                                 const Progress& progress) {
  PairExamination found = question.from > 1 ? examine_from(question, opponent, progress)
                                            : examine_whole(question, opponent, beliefs, beliefs, progress);
  found.verdicts = judge_all(found.gaps, question.sides, question.epsilon_payoff);
  return found;
}

void put_before(const std::vector<Outcome>& before, PairExamination& found) {
  put_before_deviations(before, found.gaps.first);
  std::vector<Outcome> seen_by_them;
  for (const Outcome& round : before) seen_by_them.push_back(round.exchanged());
  put_before_deviations(seen_by_them, found.gaps.second);
  if (found.thresholds)
    for (auto* threshold :
         {&found.thresholds->nash, &found.thresholds->subgame_perfect, &found.thresholds->self_confirming_unrestricted})
      if (*threshold)
        for (Binding& binding : (*threshold)->bindings)
          binding.history.insert(binding.history.begin(), before.begin(), before.end());
  found.before = before;
}

}  // namespace folk
