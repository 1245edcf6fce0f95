#pragma once
// Does a ranking depend on who happened to take part? Ranks of each strategy over the smaller tournaments within one
// (the test by sub-classes of Mathieu & Delahaye, JASSS 20(4) 12, 2017).

#include <folk/analysis/tournament/tournament.h>
#include <folk/games/integer.h>
#include <folk/games/progress.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// Which sub-rosters are looked at.
struct SubRosterSettings {
  std::size_t size = 2;  ///< strategies of a sub-roster, 2 to all
  /// Up to so many sub-rosters are all gone through. Where there are more, so many are drawn, repetitions possible,
  /// each set alike: whole decks of the roster are dealt, so that the strategies are in as many, give or take one.
  std::uint64_t samples = 1'000'000;
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< the results do not depend on it
};

/// How one strategy does in the sub-rosters that it is in. A rank is that of the tournament of the sub-roster alone:
/// one more than the strategies that earned more, so that equal totals share the better rank.
struct SubRosterRanks {
  std::uint64_t sub_rosters = 0;  ///< that it is in; of none, and nothing else is said, where few are drawn
  double mean = 0;                ///< rank
  double deviation = 0;           ///< standard deviation of the rank
  std::size_t best = 0;
  std::size_t lower_quartile = 0;  ///< the best rank that a quarter of its ranks do not exceed
  std::size_t median = 0;          ///< the same of a half
  std::size_t upper_quartile = 0;  ///< of three quarters
  std::size_t worst = 0;
  double won = 0;  ///< share of its sub-rosters in which nobody earned more; a shared first place counts for each
};

/// The ranks over sub-rosters.
struct SubRosters {
  std::size_t size = 0;
  Integer possible;                     ///< how many sub-rosters there are
  std::uint64_t looked_at = 0;          ///< how many were ranked
  bool all = true;                      ///< all of them, once each; else drawn
  std::vector<SubRosterRanks> ranks;    ///< in roster order
  std::vector<std::size_t> best_first;  ///< places in the roster by mean rank, equal ones in roster order
};

/// Ranks the sub-rosters by the scores of a finished tournament; nothing is played again. Guests of the tournament are
/// strategies like all others. Throws UsageError for a size that is not from 2 to the tournament's, no samples, or more
/// pairs of a strategy and a rank than are counted (10^7); Cancelled.
SubRosters rank_sub_rosters(const Tournament& tournament, const SubRosterSettings& settings,
                            const Progress& progress = nullptr);

}  // namespace folk
