#pragma once
// From which round on is what a pair plays an equilibrium, and are beliefs true? Eventually, learners should get there:
// Fudenberg & Levine, "The Theory of Learning in Games", 1998; Kalai & Lehrer, Econometrica 61, 1993.

#include <folk/analysis/equilibria/examination_question.h>
#include <folk/analysis/equilibria/verdict_summary.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace folk {

/// When a notion holds for good.
struct Settled {
  /// The least round such that the notion is not refuted from it on, nor from any later one; nothing where there is
  /// none, as it is refuted however late one asks.
  std::optional<std::uint64_t> from;
  Verdict verdict = Verdict::refuted;  ///< of those rounds: certified where it is for all of them
};

/// In the order of all_notions; nothing where a notion does not apply, or nothing is known of it.
using SettledNotions = std::array<std::optional<Settled>, all_notions.size()>;

struct Settlement {
  std::vector<SettledNotions> pairs;  ///< in the order of the opponents
  SettledNotions all{};               ///< from when on for all opponents for which something is known
};

/// More rounds are not looked through.
inline constexpr std::uint64_t most_settling_rounds = 1000;

/// Throws UsageError as check_noise and check_one_path do, and for finite:T of more than most_settling_rounds.
void check_settlement(const ExaminationQuestion& question);

/// Asks what `examine` asks from every round on, backwards from the last one until each notion is refuted. Of finite:T
/// that is round T. Without an end what is played repeats, together with what the machines of the class would play: the
/// last round is the one from which on nothing new comes. There machines without end are left out of the class.
/// Own beliefs of who plans are looked through once, round by round; others' are searched by halving: a round from
/// which on nothing was found to gain is taken to settle it. question.from does not count. Throws UsageError as
/// check_settlement and `examine` do, where play does not repeat within most_settling_rounds, and for a pair with a
/// machine without end under a criterion that has none.
Settlement settlement(ExaminationQuestion question, const Stages& stages = nullptr);

}  // namespace folk
