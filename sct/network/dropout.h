#pragma once
// Dropout whose every decision depends on what it is for alone, so that any split of a batch over threads drops the
// same.

#include <cstddef>
#include <cstdint>

namespace folk::sct {

/// Drops with probability p, in steps of 1/65536 (Srivastava et al. 2014); what is kept is scaled by scale().
class Dropout {
public:
  Dropout() = default;

  static constexpr double most = 65535.0 / 65536.0;

  /// `probability` is taken from [0, most]. `seed` and `step` of the training run; `pass` tells the passes of one step
  /// apart.
  Dropout(double probability, std::uint64_t seed, std::uint64_t step, std::uint32_t pass = 0);

  bool active() const { return threshold_ > 0; }

  /// What kept values are multiplied by: 1 / (1 - p).
  double scale() const { return 65536.0 / (65536.0 - threshold_); }

  /// keep[i] = 1 or 0 for `count` values of window `window` (its place in the batch) at a site of the network.
  void keep(std::uint8_t* keep, std::size_t count, std::size_t window, std::size_t site) const;

private:
  std::uint32_t threshold_ = 0;
  std::uint64_t seed_ = 0;
  std::uint64_t step_ = 0;
  std::uint32_t pass_ = 0;
};

}  // namespace folk::sct
