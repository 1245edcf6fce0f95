#pragma once
// The self-confirming loss: how wrong the beliefs are, and how unlike the data the actions that follow from them.

#include <folk/sct/network/heads.h>
#include <folk/sct/network/network.h>
#include <folk/sct/policy/policy.h>

#include <array>
#include <memory>

namespace folk::sct {

/// Mean losses over the rounds of a batch: cross-entropies where actions are discrete, squared errors where continuous.
struct Losses {
  double belief = 0;
  double action = 0;
  double next_observation = 0;
  double next_return = 0;

  double total() const { return belief + action + next_observation + next_return; }
  Losses& operator+=(const Losses& other);
};

/// What a mean is taken over: all of the batch that a chunk is part of.
template <class S>
struct Denominators {
  double rounds = 0;
  double action_weight = 0;  ///< sum of the rounds' weights in the policy loss

  explicit Denominators(const Batch<S>& batch);
};

/// The loss of one chunk and its gradient. Holds the room that this takes: one object a thread.
///
/// Passes over the network: `teacher` and `action_only` one, with the true opponent actions in the belief slots;
/// `selfconf` and `composite` two: beliefs of the first stand in the slots of the second, from which the policy loss
/// comes; the gradients of both are added (first order: none through the slots; `composite`: also through them).
template <class S>
class SelfConfirmingLoss {
public:
  /// Throws UsageError for `composite` with discrete actions. `read_everything`: compute the hidden states of all
  /// tokens but returns, for those who want to look at them.
  SelfConfirmingLoss(const Network<S>& network, LossMode mode, bool read_everything = false);

  /// The chunk's share in the means of its batch; adds to `gradient` unless it is null.
  /// `dropouts`: of the first and of the second pass.
  Losses operator()(const S* parameters, const Chunk<S>& chunk, const Denominators<S>& denominators,
                    const std::array<Dropout, 2>& dropouts, S* gradient);

  /// Of the last chunk: what each head said (the belief of the first pass), the hidden states of the last pass, which
  /// tokens of a round these are of, and what stood in its belief slots.
  const Predictions<S>& predictions() const { return predictions_; }
  const Matrix<S>& hidden() const;
  const std::vector<std::size_t>& read() const;
  const Actions<S>& fed() const { return fed_; }

  /// Tensors that this mode leaves without a gradient: an optimiser does not touch them.
  bool untouched(const Tensor& tensor) const;

private:
  bool two_passes() const { return mode_ == LossMode::selfconf || mode_ == LossMode::composite; }
  void feed_beliefs(const Chunk<S>& chunk);

  const Network<S>& network_;
  LossMode mode_;
  Heads<S> first_;   // of the only pass, or of the first
  Heads<S> second_;  // of the second
  std::array<NetworkTape<S>, 2> tapes_;
  Predictions<S> predictions_;
  Actions<S> fed_;
  Matrix<S> d_belief_, d_action_, d_opponent_;
  std::array<Matrix<S>, 2> d_hidden_;
};

}  // namespace folk::sct
