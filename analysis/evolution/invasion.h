#pragma once
// Evolutionary stability: which strategies of a finished tournament can invade which (Maynard Smith & Price 1973).

#include <folk/analysis/tournament/tournament.h>
#include <folk/games/progress.h>

#include <cstddef>
#include <string_view>
#include <vector>

namespace folk {

/// What comes of a few mutants among residents that all play the same.
enum class Invasion {
  resists,   ///< mutants earn less
  weakly,    ///< neutral drift: mutants and residents earn the same against both
  strictly,  ///< mutants earn more against residents, or the same and more among themselves
  undecided  ///< the figures are not exact enough
};

constexpr std::string_view to_string(Invasion invasion) {
  switch (invasion) {
    case Invasion::resists: return "resists";
    case Invasion::weakly: return "weakly";
    case Invasion::strictly: return "strictly";
    case Invasion::undecided: return "undecided";
  }
  return "?";
}

/// How a resident stands against all others of the roster.
enum class Stability {
  evolutionarily_stable,  ///< ESS: resists all
  neutrally_stable,       ///< nobody invades strictly
  invaded,                ///< somebody invades strictly
  undecided               ///< nobody is known to, but some pair is undecided
};

constexpr std::string_view to_string(Stability stability) {
  switch (stability) {
    case Stability::evolutionarily_stable: return "evolutionarily stable";
    case Stability::neutrally_stable: return "neutrally stable";
    case Stability::invaded: return "invaded";
    case Stability::undecided: return "undecided";
  }
  return "?";
}

/// Rounded payoffs a round that are nearer than this share of the game's largest payoff (by size) count as equal.
inline constexpr double equal_within = 1e-9;

/// Sampled scores decide when they differ by more than this many standard errors of their difference.
inline constexpr double decisive_errors = 3;

/// Who invades whom. With V(i, j) = score of i against j, mutants j invade residents i strictly when V(j,i) > V(i,i),
/// or both are equal and V(j,j) > V(i,j); weakly when these are equal too.
///
/// Exact scores (is_exact of analysis/play/pair_result.h) are compared as they are, rounded ones up to equal_within,
/// sampled ones by their standard errors; sampled scores are never found equal, those of a single repetition and scores
/// that were cut off (Method::bounded) decide nothing.
class Invasions {
public:
  /// Throws UsageError on a tournament without self-play, and Cancelled.
  explicit Invasions(const Tournament& tournament, const Progress& progress = nullptr);

  std::size_t size() const { return size_; }

  /// What comes of mutants `mutant` among `resident`; of a strategy among itself: weakly.
  Invasion invasion(std::size_t mutant, std::size_t resident) const { return cells_[resident * size_ + mutant]; }

  Stability stability(std::size_t resident) const;

  /// The mutants that fare so among `resident`, in roster order, itself left out.
  std::vector<std::size_t> mutants(std::size_t resident, Invasion how) const;

private:
  std::size_t size_;
  std::vector<Invasion> cells_;  // resident * size + mutant
};

}  // namespace folk
