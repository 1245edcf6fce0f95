#pragma once
// Random numbers that depend on what they are for, not on when they are drawn.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace folk {

/// What a stream of random numbers belongs to. The same key gives the same numbers on any thread, in any order of work.
struct RandomKey {
  std::uint64_t seed = 1;
  std::uint64_t pair = 0;        ///< which two entrants
  std::uint64_t repetition = 0;  ///< which of their matches
  std::uint64_t role = 0;        ///< 0 and 1: the players, 2: noise, 3: length of the match
};

/// Philox4x64-10 (Salmon, Moraes, Dror & Shaw 2011) over a RandomKey; a UniformRandomBitGenerator.
class RandomStream {
public:
  using result_type = std::uint64_t;

  explicit RandomStream(const RandomKey& key = {})
      : key_(key) {}

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

  result_type operator()() {
    if (used_ == 4) refill();
    return block_[used_++];
  }

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>((*this)() >> 11U) * 0x1p-53; }

  /// Standard normal (Box & Muller 1958), the second of a pair thrown away.
  double normal() {
    const double radius = std::sqrt(-2 * std::log1p(-uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

  /// True with probability p.
  bool chance(double p) { return uniform() < p; }

private:
  /// The next four numbers.
  void refill();

  RandomKey key_;
  std::uint64_t index_ = 0;
  std::array<std::uint64_t, 4> block_{};
  unsigned used_ = 4;
};

}  // namespace folk
