#pragma once
// The best memory-one reply to a population that can be found: the continuous problem of Glynatsi & Knight (2020),
// "Using a theory of mind to find best responses to memory-one strategies", Scientific Reports 10.

#include <folk/analysis/replies/memory_one_payoff.h>
#include <folk/games/progress.h>

#include <array>
#include <cstddef>
#include <optional>

namespace folk {

struct MemoryOneSearch {
  std::size_t points = 2'000;  ///< of the global stage inside the cube; a face of k dimensions gets points^(k/4)
  unsigned threads = 1;        ///< the result does not depend on it
};

/// What was searched, so that a reader can judge "best found".
struct SearchCertificate {
  std::size_t faces = 0;      ///< searched: vertices, edges, ... of the cube [0,1]^4, with either opening
  std::size_t points = 0;     ///< strategies that were evaluated
  std::size_t unsettled = 0;  ///< faces whose local stage ran out of points
  MemoryOne corner{};         ///< the best of the 32 deterministic memory-one strategies; all were evaluated
  double corner_payoff = 0;
  /// The steepest ascent that is left: along the log-odds of one of the probabilities, from 0 or 1 inwards along the
  /// probability itself (the projected gradient). 0 at a local maximum.
  double slope = 0;
  bool at_open_end = false;  ///< see MemoryOneReply
  /// What best replies earn that know whom they meet: no strategy at all, memory-one or not, earns more than
  /// unrestricted + residual.
  double unrestricted = 0;
  double residual = 0;
};

/// The best reply found. It is proved to be a best one only where its payoff reaches certificate.unrestricted.
///
/// `at_open_end`: for mean without noise what is earned can jump where a probability becomes 0 or 1, and a supremum
/// need not be reached: the reply then stands less than 10^-6 short of such an end.
struct MemoryOneReply {
  MemoryOne strategy{};
  double payoff = 0;  ///< mean over the population, in the criterion's unit
  SearchCertificate certificate{};
};

/// How near to the ends of a face its inside is searched.
inline constexpr double open_end = 1e-9;

/// Searches the opening move and the four probabilities.
///
/// The payoff is analytic inside each face of the cube [0,1]^4 (there the play can reach the same joint states), but
/// for mean without noise not from one face to the next. So every face is searched by itself, for either opening:
/// global (DIRECT-L), then local (BOBYQA; once more in log-odds, since near an open end
/// it counts how small a probability is), see box_search.h; the 32 vertices are evaluated. Of replies that earn the
/// same to a part in 10^9 the one on the smallest face is taken.
///
/// certificate.unrestricted is the mean by weight of what best replies to the members earn
/// (analysis/replies/best_reply.h): against one opponent the exact optimum among all strategies, against several an
/// upper bound. `progress` is told the finished share. Throws UsageError when that cannot be had, as best_reply does,
/// and Cancelled.
MemoryOneReply memory_one_reply(const WeightedOpponents& population, const MemoryOneSearch& search = {},
                                const Progress& progress = nullptr);

}  // namespace folk
