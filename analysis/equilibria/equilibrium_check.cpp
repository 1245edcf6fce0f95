#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/equilibria/nash_gap.h>
#include <folk/analysis/equilibria/self_confirming_gap.h>
#include <folk/analysis/equilibria/subgame_perfect_gap.h>
#include <folk/analysis/play/criterion_table.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <utility>

namespace folk {
namespace {

/// What one side can gain over a path without chance.
SideGaps gaps_over(const PlayPath& path, const Machine* theirs, const EquilibriumQuestion& question,
                   ClassReplies& beliefs) {
  const auto& payoffs = question.payoffs;
  const auto& criterion = question.criterion;
  SideGaps gaps;
  if (theirs != nullptr) gaps.nash = nash_gap(path, *theirs, payoffs, criterion, question.horizon);
  gaps.self_confirming_unrestricted = unrestricted_gap(path, payoffs, criterion);
  gaps.self_confirming_class = class_gap(path, beliefs);
  return gaps;
}

SideGaps gaps_by_chance(const Automaton& own, const Automaton& theirs, ClassReplies& beliefs) {
  const auto& payoffs = beliefs.payoffs();
  const auto& criterion = beliefs.criterion();
  SideGaps gaps;
  gaps.nash = nash_gap(own, theirs, payoffs, criterion);
  gaps.self_confirming_unrestricted = unrestricted_gap(own, theirs, payoffs, criterion);
  gaps.self_confirming_class = class_gap(own, theirs, beliefs);
  return gaps;
}

/// Subgame perfection wants every joint state; pairs that have too many of them are left undecided.
void add_subgame_perfect(PairGaps& gaps, const Machine& first, const Machine& second,
                         const EquilibriumQuestion& question) {
  const auto& criterion = question.criterion;
  if (!criterion.is_finite() && (!first.finite() || !second.finite())) return;
  try {
    const Automaton a = minimise(table_for(first, criterion, Sense::any_own_moves, 0), Sense::any_own_moves);
    const Automaton b = minimise(table_for(second, criterion, Sense::any_own_moves, 0), Sense::any_own_moves);
    auto [own, theirs] = subgame_perfect_gaps(a, b, question.payoffs, criterion);
    gaps.first.subgame_perfect = std::move(own);
    gaps.second.subgame_perfect = std::move(theirs);
  } catch (const UsageError&) {
    // Too many joint states: null says so.
  }
}

}  // namespace

ClassReplies class_replies(const EquilibriumQuestion& question) {
  return {question.beliefs, question.payoffs, question.criterion, question.horizon};
}

PairGaps match_gaps(const PlayPath& match, const Machine* first, const Machine* second,
                    const EquilibriumQuestion& question) {
  ClassReplies beliefs = class_replies(question);
  return match_gaps(match, first, second, question, beliefs);
}

PairGaps match_gaps(const PlayPath& match, const Machine* first, const Machine* second,
                    const EquilibriumQuestion& question, ClassReplies& beliefs) {
  return {gaps_over(match, second, question, beliefs), gaps_over(match.exchanged(), first, question, beliefs)};
}

PairGaps pair_gaps(const Machine& first, const Machine& second, const EquilibriumQuestion& question) {
  ClassReplies beliefs = class_replies(question);
  return pair_gaps(first, second, question, beliefs);
}

PairGaps pair_gaps(const Machine& first, const Machine& second, const EquilibriumQuestion& question,
                   ClassReplies& beliefs) {
  const auto& criterion = question.criterion;
  PairGaps gaps;
  if (first.deterministic() && second.deterministic()) {
    if (!criterion.is_finite())  // refuse machines without end before their path is sought
      for (const Machine* machine : {&first, &second})
        if (!machine->finite()) table_for(*machine, criterion, Sense::own_moves_its_own, question.horizon);
    const PlayPath path = play_path(first, second, criterion, question.horizon);
    gaps = match_gaps(path, &first, &second, question, beliefs);
  } else {
    if (!criterion.is_finite() && !(first.finite() && second.finite()))
      throw UsageError(
          fmt::format("a machine without end in a pair that mixes, under {}: no --horizon helps, take finite:T",
                      criterion.to_string()));
    const Automaton a = table_for(first, criterion, Sense::own_moves_its_own, 0);
    const Automaton b = table_for(second, criterion, Sense::own_moves_its_own, 0);
    gaps.first = gaps_by_chance(a, b, beliefs);
    gaps.second = gaps_by_chance(b, a, beliefs);
  }
  add_subgame_perfect(gaps, first, second, question);
  return gaps;
}

}  // namespace folk
