#pragma once
// A monotone mixer of values: which share each of several values has in their sum is for a state to say.

#include <folk/mpe/network/mlp.h>

#include <cstddef>

namespace folk::mpe {

/// Its one layer, from the state to 32 numbers for each value and 32 for all of them: what QMIX (Rashid et al. 2018)
/// makes the weights of its own two layers of.
class MixerShape {
public:
  static constexpr std::size_t width = 32;

  MixerShape(std::size_t state, std::size_t values)
      : values_(values),
        layer_({state, width * (values + 1)}) {}

  std::size_t values() const { return values_; }
  const MlpShape& layer() const { return layer_; }
  std::size_t parameters() const { return layer_.parameters(); }

private:
  std::size_t values_;
  MlpShape layer_;
};

/// What a forward pass leaves for the backward pass, and its result.
template <class S>
struct MixerTape {
  MlpTape<S> layer;   ///< the states [rows, state] are its input
  Matrix<S> weights;  ///< k [rows, values], above 0, of sum 1 in each row
  Matrix<S> totals;   ///< what they were divided by [rows, 1]
  Matrix<S> layer_gradient;
};

/// Weights k_i ~ sum over 32 of |w_i| |v|, normalised to sum 1, as ICQ's mixer has them (Yang et al. 2021). A sum of 0
/// is no state's to give: each is 1e-10 more, which is ours.
template <class S>
void mixing_weights(const MixerShape& shape, const S* parameters, MixerTape<S>& tape);

/// mixed [rows, 1] = sum of k_i times `values` [rows, values].
template <class S>
void mix(const MixerTape<S>& tape, const Matrix<S>& values, Matrix<S>& mixed);

/// Adds the gradient of the parameters to `gradient`, from `mixed_gradient` [rows, 1], that with respect to what mix
/// made of the values. The gradient of value i is mixed_gradient * k_i.
template <class S>
void mixer_backward(const MixerShape& shape, const S* parameters, MixerTape<S>& tape, const Matrix<S>& values,
                    const Matrix<S>& mixed, const Matrix<S>& mixed_gradient, S* gradient);

}  // namespace folk::mpe
