#pragma once
// What strategies are drawn from: a list, and families too large to be listed.

#include <folk/games/integer.h>
#include <folk/strategies/half.h>
#include <folk/strategies/strategy.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// Strategies that have numbers from 0 on, so that some of them can be had without a list of all.
struct Family {
  /// Rosters list the members of families up to this size, to play them one by one.
  static constexpr std::uint64_t most_listed = 20'000;

  std::string name;  ///< "memory(2,2)"
  Integer size;
  std::function<Strategy(const Integer& number)> member;
  std::string refusal{};       ///< what to say to one who asks for the list of a family that has too many
  std::optional<Half> half{};  ///< of its members only those in this half
};

struct Pool {
  std::vector<Strategy> listed;
  std::vector<Family> unlisted;  ///< each larger than Family::most_listed
};

/// The members of a family in the order of their numbers where they can be listed, else the family as it is.
Pool pool_of(Family family);

/// All strategies of the pool. Throws UsageError when some of them are too many to be listed.
std::vector<Strategy> list_of(Pool pool);

/// The strategies of the pool that are in this half. Throws UsageError for a strategy that is no machine, and when
/// none is left.
Pool half_of(Pool pool, Half half);

/// `count` different strategies of the pool, each set of them as likely as any other, in the pool's order. Draws from a
/// stream of its own of `seed`, so that the first n that are drawn do not depend on how many follow: a larger sample
/// with the same seed holds the smaller one. Throws UsageError for 0, for more than Family::most_listed, and for more
/// than there are.
std::vector<Strategy> sample_of(const Pool& pool, std::uint64_t count, std::uint64_t seed);

}  // namespace folk
