#pragma once
// The stream of numpy.random.seed(s), so that recorded resets can be repeated.

#include <cstdint>
#include <random>

namespace folk::mpe {

/// numpy's legacy generator: MT19937 (Matsumoto & Nishimura 1998) started from one 32-bit word, doubles of 53 bits from
/// two words each.
class NumpyRandom {
public:
  explicit NumpyRandom(std::uint32_t seed)
      : words_(seed) {}

  /// random_sample(): uniform in [0, 1).
  double uniform() {
    const auto high = static_cast<std::uint64_t>(words_()) >> 5U;
    const auto low = static_cast<std::uint64_t>(words_()) >> 6U;
    return static_cast<double>((high << 26U) + low) * 0x1p-53;
  }

private:
  std::mt19937 words_;
};

}  // namespace folk::mpe
