#pragma once
// Claims about a pair of strategies: what is claimed, with which of three verdicts, by which margin, shown by what.

#include <folk/analysis/beliefs/belief_consistency.h>
#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/thresholds/thresholds.h>
#include <folk/games/outcome.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace folk {

/// What may be claimed.
enum class Notion : std::size_t {
  nash,
  subgame_perfect,
  self_confirming_unrestricted,
  self_confirming_class,
  self_confirming_own,
  beliefs  ///< the first player's beliefs are those of the path
};

inline constexpr std::array<Notion, 6> all_notions{Notion::nash,
                                                   Notion::subgame_perfect,
                                                   Notion::self_confirming_unrestricted,
                                                   Notion::self_confirming_class,
                                                   Notion::self_confirming_own,
                                                   Notion::beliefs};

/// "nash", "subgame_perfect", ...
std::string_view to_string(Notion notion);

/// The three words that a claim may have.
enum class Verdict {
  certified,    ///< exact: it holds
  not_refuted,  ///< nothing against it was found, and not everything was tried
  refuted       ///< a deviation gains more than is allowed
};

/// A claim that was judged.
struct Certificate {
  Verdict verdict = Verdict::not_refuted;
  std::string scope;                         ///< not refuted: how far was looked ("depth 6")
  Seat side = Seat::first;                   ///< whose gain the margin is: the side with the larger one
  double margin = 0;                         ///< the largest gain; for beliefs the largest distance
  std::string margin_exact;                  ///< the same exactly, where it is known
  std::shared_ptr<const Automaton> reply{};  ///< the best reply that gains, where one does
  std::string witness;  ///< for people: the deviation, or the machine that the other side may be held to be

  /// "certified", "not refuted (depth 6)", "refuted".
  std::string text() const;
};

/// The gap of a notion, where it is one.
const std::optional<Gap>& gap_of(const SideGaps& gaps, Notion notion);

/// What the gaps say of a notion when neither side (of `sides`) may gain more than `epsilon`. What refutes Nash refutes
/// subgame perfection too. Nothing where the notion does not apply, or nothing is known of it.
std::optional<Certificate> judge(const PairGaps& gaps, Notion notion, Sides sides, const Rational& epsilon);

/// Beliefs are consistent when no distance on the path exceeds `epsilon`; `whole_path`: all of it was seen.
/// Nothing without beliefs.
std::optional<Certificate> judge_beliefs(const BeliefConsistency& beliefs, double epsilon, bool whole_path);

/// A history as people write it: "CC CC CD", own move first; long ones with their repetitions counted: "(CC)99".
std::string history_text(const std::vector<Outcome>& history);

/// A deviation in words: "in round 3, after CC CD, D instead of C, then best reply".
std::string witness_text(const Gap& gap);

}  // namespace folk
