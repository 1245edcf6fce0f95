#include <folk/analysis/play/parallel.h>
#include <folk/sct/training/batch_gradient.h>

#include <algorithm>

namespace folk::sct {
namespace {

constexpr std::size_t lane_count = 8;
constexpr std::size_t chunk_windows = 4;

}  // namespace

template <class S>
BatchGradient<S>::BatchGradient(const Network<S>& network, LossMode mode, unsigned threads)
    : network_(network),
      threads_(threads),
      lanes_(lane_count) {
  for (unsigned t = 0; t < threads; ++t) workers_.emplace_back(network, mode);
  for (const auto& tensor : network.layout().tensors()) {
    if (workers_.front().untouched(tensor)) continue;
    if (!touched_.empty() && touched_.back().second == tensor.offset)
      touched_.back().second += tensor.size();
    else
      touched_.emplace_back(tensor.offset, tensor.offset + tensor.size());
  }
}

template <class S>
Losses BatchGradient<S>::run_lane(std::size_t lane, unsigned worker, std::span<const S> parameters,
                                  const Batch<S>& batch, const StepDropout& dropout) {
  lanes_[lane].setZero(index(parameters.size()));
  const Denominators<S> denominators(batch);
  const std::array<Dropout, 2> dropouts{Dropout(dropout.probability, dropout.seed, dropout.step, 0),
                                        Dropout(dropout.probability, dropout.seed, dropout.step, 1)};
  const std::size_t begin = lane * batch.windows() / lane_count;
  const std::size_t end = (lane + 1) * batch.windows() / lane_count;
  std::size_t round = 0;
  for (std::size_t w = 0; w < begin; ++w) round += batch.window_rounds[w];
  Losses losses;
  for (std::size_t w = begin; w < end; w += chunk_windows) {
    const Chunk<S> chunk{
        batch, w, round,
        std::span<const std::size_t>(batch.window_rounds).subspan(w, std::min(chunk_windows, end - w))};
    losses += workers_[worker](parameters.data(), chunk, denominators, dropouts, lanes_[lane].data());
    round += chunk.rounds();
  }
  return losses;
}

template <class S>
void BatchGradient<S>::add_lanes(std::span<S> gradient) {
  constexpr std::size_t piece = 1U << 15U;
  parallel_for((gradient.size() + piece - 1) / piece, threads_, [&](std::size_t i, unsigned) {
    const std::size_t begin = i * piece;
    const Index size = index(std::min(piece, gradient.size() - begin));
    Eigen::Map<RowVector<S>> sum(gradient.data() + begin, size);
    sum.setZero();
    for (const auto& lane : lanes_) sum += Eigen::Map<const RowVector<S>>(lane.data() + begin, size);
  });
}

template <class S>
Losses BatchGradient<S>::operator()(std::span<const S> parameters, const Batch<S>& batch, const StepDropout& dropout,
                                    std::span<S> gradient) {
  std::vector<Losses> losses(lane_count);
  parallel_for(lane_count, threads_, [&](std::size_t lane, unsigned worker) {
    losses[lane] = run_lane(lane, worker, parameters, batch, dropout);
  });
  add_lanes(gradient);
  Losses sum;
  for (const auto& lane : losses) sum += lane;
  return sum;
}

template class BatchGradient<float>;
template class BatchGradient<double>;

}  // namespace folk::sct
