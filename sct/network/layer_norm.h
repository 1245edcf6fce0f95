#pragma once
// Layer normalisation of each row (Ba, Kiros & Hinton 2016), eps 1e-5, forward and backward.

#include <folk/sct/network/matrix.h>

#include <vector>

namespace folk::sct {

/// What the backward pass needs.
template <class S>
struct LayerNormTape {
  Matrix<S> normal;        ///< (x - mean) / deviation  [rows, h]
  std::vector<S> inverse;  ///< 1 / deviation  [rows]
};

/// y = normal * gain + bias  [rows, h]
template <class S>
void layer_norm(const Matrix<S>& x, const S* gain, const S* bias, LayerNormTape<S>& tape, Matrix<S>& y);

/// dx += the gradient through the normalisation; d_gain and d_bias are added to.
template <class S>
void layer_norm_backward(const Matrix<S>& dy, const S* gain, const LayerNormTape<S>& tape, S* d_gain, S* d_bias,
                         Matrix<S>& dx);

}  // namespace folk::sct
