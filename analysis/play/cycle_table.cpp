#include <folk/analysis/play/cycle_table.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace folk {
namespace {

std::uint64_t one_of(std::uint32_t o) { return std::uint64_t{1} << (16U * o); }

/// Adds `times` copies of packed counts.
void add(OutcomeWeights& weights, std::uint64_t packed, double times) {
  for (std::size_t o = 0; o < 4; ++o)
    weights[o] += times * static_cast<double>((packed >> (16U * static_cast<unsigned>(o))) & 0xFFFFU);
}

}  // namespace

CycleTable::CycleTable(const Automaton& automaton) {
  if (!automaton.deterministic()) throw std::logic_error("a cycle table needs a deterministic automaton");
  const auto& nodes = automaton.nodes();
  const auto coded = [&](std::uint32_t node) { return 2 * node + (nodes[node].cooperation > 0.5 ? 0U : 1U); };
  for (const auto& node : nodes) {
    const std::size_t own = node.cooperation > 0.5 ? 0 : 2;
    next_.push_back(coded(node.next[own]));
    next_.push_back(coded(node.next[own + 1]));
  }
  start_ = coded(static_cast<std::uint32_t>(automaton.start()));
}

PairResult CycleFinder::play(const CycleTable& first, const CycleTable& second, const Criterion& criterion) {
  PairResult pair;
  switch (criterion.kind()) {
    case Criterion::Kind::finite:
      walk(first, second, criterion.rounds());
      pair.weights = sum_finite(criterion.rounds());
      break;
    case Criterion::Kind::mean:
      walk(first, second, std::numeric_limits<std::uint64_t>::max());
      pair.weights = mean_of_cycle();
      break;
    case Criterion::Kind::discounted:
    case Criterion::Kind::ending:
      walk(first, second, std::numeric_limits<std::uint64_t>::max());
      pair.weights = sum_geometric(criterion);
      if (criterion.kind() == Criterion::Kind::discounted)
        for (double& weight : pair.weights) weight *= criterion.stopping();
      break;
  }
  return pair;
}

void CycleFinder::walk(const CycleTable& first, const CycleTable& second, std::uint64_t rounds) {
  const std::size_t joint_states = first.size() * second.size();
  if (marks_.size() < joint_states) marks_.resize(joint_states);
  if (counts_.size() < joint_states + 1) counts_.resize(joint_states + 1);
  if (epoch_ > last_epoch) {
    marks_.assign(marks_.size(), 0);
    epoch_ = 1;
  }
  std::uint32_t* const marks = marks_.data();
  std::uint64_t* const counts = counts_.data();
  const std::uint32_t epoch = epoch_;
  const auto width = static_cast<std::uint32_t>(second.size());
  const auto most = static_cast<std::uint32_t>(std::min<std::uint64_t>(rounds, joint_states));
  std::uint32_t x = first.start();
  std::uint32_t y = second.start();
  std::uint32_t t = 0;
  std::uint64_t counted = 0;
  counts[0] = 0;
  cycle_begin_ = cycle_end_ = most;  // no cycle within the rounds that are asked for
  for (;; ++t) {
    std::uint32_t& mark = marks[(x >> 1U) * width + (y >> 1U)];
    if (mark >= epoch) {
      cycle_begin_ = mark - epoch;
      cycle_end_ = t;
      break;
    }
    if (t == most) break;
    mark = epoch + t;
    counted += one_of(2 * (x & 1U) + (y & 1U));
    counts[t + 1] = counted;
    const std::uint32_t next_x = first.next(x, y);
    y = second.next(y, x);
    x = next_x;
  }
  epoch_ = epoch + t + 1;
}

OutcomeWeights CycleFinder::sum_finite(std::uint64_t rounds) const {
  OutcomeWeights weights{};
  add(weights, counts_[cycle_begin_], 1);
  const std::uint64_t length = cycle_end_ - cycle_begin_;
  if (length == 0) return weights;
  const std::uint64_t after = rounds - cycle_begin_;
  add(weights, counts_[cycle_end_] - counts_[cycle_begin_], static_cast<double>(after / length));
  add(weights, counts_[cycle_begin_ + after % length] - counts_[cycle_begin_], 1);
  return weights;
}

OutcomeWeights CycleFinder::sum_geometric(const Criterion& criterion) const {
  OutcomeWeights weights{};
  double weight = 1;
  OutcomeWeights cycle{};
  const double continuation = criterion.continuation();
  const double repeats = 1 / criterion.lost_within(static_cast<double>(cycle_end_ - cycle_begin_));
  for (std::size_t t = 0; t < cycle_end_; ++t) {
    OutcomeWeights& part = t < cycle_begin_ ? weights : cycle;
    add(part, counts_[t + 1] - counts_[t], weight);
    weight *= continuation;
  }
  for (std::size_t o = 0; o < 4; ++o) weights[o] += repeats * cycle[o];
  return weights;
}

OutcomeWeights CycleFinder::mean_of_cycle() const {
  OutcomeWeights weights{};
  add(weights, counts_[cycle_end_] - counts_[cycle_begin_], 1);
  for (double& weight : weights) weight /= static_cast<double>(cycle_end_ - cycle_begin_);
  return weights;
}

}  // namespace folk
