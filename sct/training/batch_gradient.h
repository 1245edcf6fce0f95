#pragma once
// The gradient of a whole batch, on several threads, with the same bits for any number of them.

#include <folk/sct/training/self_confirming_loss.h>

#include <cstdint>
#include <span>
#include <vector>

namespace folk::sct {

/// What is dropped in one training step.
struct StepDropout {
  double probability = 0;
  std::uint64_t seed = 1;
  std::uint64_t step = 0;
};

/// The windows of a batch are dealt to a fixed number of lanes; a lane adds up its windows' gradients in their order, a
/// few windows at a time so that they stay in the cache, and the lanes' gradients are added in the order of the lanes.
template <class S>
class BatchGradient {
public:
  /// `network` must outlive this.
  BatchGradient(const Network<S>& network, LossMode mode, unsigned threads);

  /// The losses of the batch; `gradient` (of the parameters' size) is overwritten.
  Losses operator()(std::span<const S> parameters, const Batch<S>& batch, const StepDropout& dropout,
                    std::span<S> gradient);

  /// [begin, end) of the parameters that this loss has a gradient for.
  const std::vector<std::pair<std::size_t, std::size_t>>& touched() const { return touched_; }

private:
  Losses run_lane(std::size_t lane, unsigned worker, std::span<const S> parameters, const Batch<S>& batch,
                  const StepDropout& dropout);
  void add_lanes(std::span<S> gradient);

  const Network<S>& network_;
  unsigned threads_;
  std::vector<SelfConfirmingLoss<S>> workers_;  // one a thread
  std::vector<RowVector<S>> lanes_;             // aligned by Eigen: some last bits depend on the address
  std::vector<std::pair<std::size_t, std::size_t>> touched_;
};

}  // namespace folk::sct
