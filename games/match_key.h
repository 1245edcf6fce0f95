#pragma once
// What draws random numbers in a match, each from a stream of its own.

#include <folk/games/random.h>
#include <folk/games/seat.h>

#include <cstdint>

namespace folk {

/// The numbers are part of what a seed means: others would change every seeded result.
enum class MatchRole : std::uint64_t { first = 0, second = 1, noise = 2, length = 3 };

/// The player in this seat.
constexpr MatchRole role_of(Seat seat) { return seat == Seat::first ? MatchRole::first : MatchRole::second; }

/// The key of one who draws in the match with this number (`repetition`) of a pair.
constexpr RandomKey match_key(std::uint64_t seed, std::uint64_t pair, std::uint64_t repetition, MatchRole role) {
  return {seed, pair, repetition, static_cast<std::uint64_t>(role)};
}

}  // namespace folk
