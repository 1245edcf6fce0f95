#pragma once
// The loss of behaviour cloning, and its gradient: how far a network's actions are from those that were taken.

#include <folk/analysis/play/workers.h>
#include <folk/mpe/network/mlp.h>

#include <vector>

namespace folk::mpe {

/// What a step learns from, an example a row. Examples come with the longest histories first, so that what is zero in
/// all that follow is not multiplied.
template <class S>
struct BcExamples {
  Matrix<S> windows;           ///< [rows, inputs]
  std::vector<Index> padding;  ///< how many zeros each window begins with; never fewer than the one before
  Matrix<S> actions;           ///< [rows, outputs], what to say

  /// Of each hidden layer [rows, width]: 0 where a unit is dropped, and what it is multiplied by where it is kept.
  std::vector<Matrix<S>> dropout;
};

/// What is computed on the way, kept so that memory is asked for once.
template <class S>
struct BcTape {
  std::vector<Matrix<S>> values;     ///< what leaves each layer [rows, outputs of the layer]
  std::vector<Matrix<S>> gradients;  ///< with respect to the sums of each layer
};

/// The mean over examples and outputs of (y - action)^2, y being tanh of the network's output, and hidden units ReLU
/// and then dropped. `gradient` [parameters] is set to that of the loss. The workers share the units of the first
/// layer, which is most of the work; the result does not depend on how many they are.
template <class S>
double bc_loss(const MlpShape& shape, const S* parameters, const BcExamples<S>& examples, BcTape<S>& tape, S* gradient,
               Workers& workers);

}  // namespace folk::mpe
