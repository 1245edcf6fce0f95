#pragma once
// AdamW (Loshchilov & Hutter 2019) with the gradient's norm clipped and the learning rate warmed up.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace folk::sct {

struct AdamWSettings {
  double learning_rate = 1e-4;
  double weight_decay = 1e-4;  ///< of every tensor, biases and normalisations included
  double beta_1 = 0.9;
  double beta_2 = 0.999;
  double epsilon = 1e-8;
  double clip = 0.25;                   ///< largest norm of the whole gradient
  std::uint64_t warmup_steps = 10'000;  ///< the rate is learning_rate * min((step + 1) / warmup_steps, 1)
  std::uint64_t decay_steps =
      0;  ///< and falls along a half cosine to 0 at this step (Loshchilov & Hutter 2017); 0: never

  double rate(std::uint64_t step) const;
};

/// First and second moments of the gradient, and how many steps were taken.
template <class S>
struct AdamWState {
  std::vector<S> first;
  std::vector<S> second;
  std::uint64_t steps = 0;
};

/// The Euclidean norm, summed in double.
template <class S>
double norm(std::span<const S> gradient);

/// One step in place. `parts`: [begin, end) of the parameters that have a gradient; all others stay untouched.
/// Returns the norm before clipping.
template <class S>
double adamw_step(const AdamWSettings& settings, std::span<const std::pair<std::size_t, std::size_t>> parts,
                  std::span<const S> gradient, AdamWState<S>& state, std::span<S> parameters);

}  // namespace folk::sct
