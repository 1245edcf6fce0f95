#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/equilibria/nash_gap.h>
#include <folk/analysis/equilibria/self_confirming_gap.h>
#include <folk/analysis/equilibria/subgame_perfect_gap.h>
#include <folk/games/error.h>

#include <memory>
#include <utility>

namespace folk {
namespace {

// Shares of the work that is left, roughly: a side's first notion, the two sides' paths.
constexpr double nash_share = 0.2;
constexpr double paths_share = 0.8;

/// What one side can gain over a path without chance.
SideGaps gaps_over(const PlayPath& path, PreparedMachine* theirs, unsigned horizon, ClassReplies& beliefs,
                   const Progress& progress) {
  const PathPayoffs paid(path, beliefs.payoffs(), beliefs.criterion());
  SideGaps gaps;
  if (theirs != nullptr) gaps.nash = reply_gap(path, paid, theirs->reply(horizon));
  progress(nash_share);
  gaps.self_confirming_unrestricted = unrestricted_gap(path, paid, beliefs.payoffs());
  gaps.self_confirming_class = class_gap(path, paid, beliefs, progress.part(nash_share, 1));
  return gaps;
}

SideGaps gaps_by_chance(PreparedMachine& own, PreparedMachine& theirs, ClassReplies& beliefs,
                        const Progress& progress) {
  const auto& payoffs = beliefs.payoffs();
  const auto& criterion = beliefs.criterion();
  const double paid = expected_payoff(own.table(), theirs.table(), beliefs.rules());
  SideGaps gaps;
  gaps.nash = reply_gap(paid, rounding_of(payoffs, criterion), theirs.reply());
  progress(nash_share);
  if (beliefs.rules().noise > 0) {
    gaps.self_confirming_unrestricted = gaps.nash;  // every history comes about: no belief is free
    gaps.self_confirming_class =
        class_gap_under_noise(theirs.machine(), *gaps.nash, beliefs, progress.part(nash_share, 1));
    return gaps;
  }
  gaps.self_confirming_unrestricted = unrestricted_gap(own.table(), theirs.table(), paid, payoffs, criterion);
  gaps.self_confirming_class = class_gap(own.table(), theirs.table(), paid, beliefs, progress.part(nash_share, 1));
  return gaps;
}

/// Who proves under noise that no history leaves anything to gain has proved it from the start on.
void carry_proof(SideGaps& gaps) {
  if (!gaps.subgame_perfect || gaps.subgame_perfect->exact != Rational(0)) return;
  for (auto* gap : {&gaps.nash, &gaps.self_confirming_unrestricted, &gaps.self_confirming_class})
    if (*gap && !(*gap)->bounded()) *gap = exact_gap(0, std::move((*gap)->witness));
}

/// Subgame perfection wants every joint state; pairs that have too many of them are left undecided.
void add_subgame_perfect(PairGaps& gaps, const PreparedPair& pair) {
  if (pair.first().endless() || pair.second().endless()) return;
  try {
    auto [own, theirs] = subgame_perfect_gaps(pair.first().minimal(), pair.second().minimal(), pair.first().rules());
    gaps.first.subgame_perfect = std::move(own);
    gaps.second.subgame_perfect = std::move(theirs);
    if (pair.first().rules().noise == 0) return;
    carry_proof(gaps.first);
    carry_proof(gaps.second);
  } catch (const UsageError&) {
    // Too many joint states: null says so.
  }
}

/// A machine that the caller keeps.
std::shared_ptr<const Machine> lent(const Machine& machine) { return {std::shared_ptr<const Machine>(), &machine}; }

PairGaps gaps_over_both(const PlayPath& match, PreparedMachine* first, PreparedMachine* second, unsigned horizon,
                        ClassReplies& beliefs, ClassReplies& their_beliefs, const Progress& progress) {
  return {gaps_over(match, second, horizon, beliefs, progress.part(0, 0.5)),
          gaps_over(match.exchanged(), first, horizon, their_beliefs, progress.part(0.5, 1))};
}

}  // namespace

ClassReplies class_replies(const EquilibriumQuestion& question) {
  return {question.beliefs, question, question.horizon};
}

PairGaps match_gaps(const PlayPath& match, PreparedMachine* first, PreparedMachine* second, ClassReplies& beliefs,
                    const Progress& progress) {
  return match_gaps(match, first, second, beliefs, beliefs, progress);
}

PairGaps match_gaps(const PlayPath& match, PreparedMachine* first, PreparedMachine* second, ClassReplies& beliefs,
                    ClassReplies& their_beliefs, const Progress& progress) {
  // A match has an end: no horizon counts.
  return gaps_over_both(match, first, second, 0, beliefs, their_beliefs, progress);
}

PairGaps match_gaps(const PlayPath& match, const Machine* first, const Machine* second,
                    const EquilibriumQuestion& question, const Progress& progress) {
  ClassReplies beliefs = class_replies(question);
  return match_gaps(match, first, second, question, beliefs, progress);
}

PairGaps match_gaps(const PlayPath& match, const Machine* first, const Machine* second,
                    const EquilibriumQuestion& question, ClassReplies& beliefs, const Progress& progress) {
  PreparedMachines machines(question);
  const auto prepared = [&](const Machine* machine) { return machine ? &machines.of(lent(*machine)) : nullptr; };
  return gaps_over_both(match, prepared(first), prepared(second), question.horizon, beliefs, beliefs, progress);
}

PairGaps pair_gaps(const PreparedPair& pair, ClassReplies& beliefs, const Progress& progress) {
  return pair_gaps(pair, beliefs, beliefs, progress);
}

PairGaps pair_gaps(const PreparedPair& pair, ClassReplies& beliefs, ClassReplies& their_beliefs,
                   const Progress& progress) {
  const Progress paths = progress.part(0, paths_share);
  PairGaps gaps;
  if (pair.path()) {
    gaps = gaps_over_both(*pair.path(), &pair.first(), &pair.second(), pair.horizon(), beliefs, their_beliefs, paths);
  } else {
    gaps.first = gaps_by_chance(pair.first(), pair.second(), beliefs, paths.part(0, 0.5));
    gaps.second = gaps_by_chance(pair.second(), pair.first(), their_beliefs, paths.part(0.5, 1));
  }
  add_subgame_perfect(gaps, pair);
  progress(1);
  return gaps;
}

PairGaps pair_gaps(const Machine& first, const Machine& second, const EquilibriumQuestion& question,
                   const Progress& progress) {
  ClassReplies beliefs = class_replies(question);
  return pair_gaps(first, second, question, beliefs, progress);
}

PairGaps pair_gaps(const Machine& first, const Machine& second, const EquilibriumQuestion& question,
                   ClassReplies& beliefs, const Progress& progress) {
  PreparedMachines machines(question);
  return pair_gaps(PreparedPair(machines.of(lent(first)), machines.of(lent(second)), question.horizon), beliefs,
                   progress);
}

}  // namespace folk
