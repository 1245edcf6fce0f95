#pragma once
// Random small transformers and batches for tests of the network: all shapes that the architecture allows.

#include <folk/games/random.h>
#include <folk/sct/training/self_confirming_loss.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace folk::test {

/// Draws from a list or a range, and from the normal distribution.
class Draw {
public:
  explicit Draw(std::uint64_t seed)
      : random_({seed, 0, 0, 0}) {}

  /// least <= n <= most
  std::size_t between(std::size_t least, std::size_t most) {
    return least + static_cast<std::size_t>(random_.uniform() * static_cast<double>(most - least + 1));
  }
  bool chance(double p) { return random_.chance(p); }

  /// In (-1, 1).
  double number() { return 2 * random_.uniform() - 1; }

  double normal() {
    const double radius = std::sqrt(-2 * std::log1p(-random_.uniform()));
    return radius * std::cos(2 * std::numbers::pi * random_.uniform());
  }

private:
  RandomStream random_;
};

/// Continuous actions for `composite`, a belief token nearly always.
inline sct::Architecture random_architecture(sct::LossMode mode, Draw& draw) {
  sct::Architecture a;
  a.heads = draw.between(1, 4);
  a.hidden = a.heads * draw.between(4 / a.heads + (4 % a.heads == 0 ? 0U : 1U), 12 / a.heads);
  a.layers = draw.between(1, 3);
  a.context = draw.between(1, 4);
  a.time_rows = draw.between(a.context, 6);
  a.observation_size = draw.between(1, 4);
  a.agents = draw.between(1, 3);
  a.discrete = mode != sct::LossMode::composite && draw.chance(0.5);
  a.action_size = draw.between(a.discrete ? 2 : 1, 3);
  a.readout =
      std::array{sct::Readout::token, sct::Readout::cat, sct::Readout::add, sct::Readout::own}[draw.between(0, 3)];
  if (a.readout == sct::Readout::own) a.belief_token = draw.chance(0.5);
  a.auxiliary = draw.chance(0.5);
  return a;
}

/// Larger than a network starts with, so that no part of the gradient is small; gains stay about 1.
template <class S>
std::vector<S> random_parameters(const sct::Architecture& architecture, Draw& draw) {
  const sct::ParameterLayout layout(architecture);
  std::vector<S> parameters(layout.size());
  for (const auto& tensor : layout.tensors()) {
    const bool gain = tensor.name.ends_with(".weight") && tensor.shape.size() == 1;
    for (std::size_t i = 0; i < tensor.size(); ++i)
      parameters[tensor.offset + i] = static_cast<S>((gain ? 1 : 0) + (gain ? 0.2 : 0.4) * draw.normal());
  }
  return parameters;
}

template <class S>
sct::Actions<S> random_actions(const sct::Architecture& architecture, std::size_t count, Draw& draw) {
  sct::Actions<S> actions;
  for (std::size_t i = 0; i < count; ++i) {
    if (architecture.discrete)
      actions.classes.push_back(static_cast<std::int32_t>(draw.between(0, architecture.action_size - 1)));
    for (std::size_t k = 0; !architecture.discrete && k < architecture.action_size; ++k)
      actions.numbers.push_back(static_cast<S>(draw.number()));
  }
  return actions;
}

/// `windows` windows of different lengths; weights and wanted actions in half of the batches each.
template <class S>
sct::Batch<S> random_batch(const sct::Architecture& architecture, std::size_t windows, Draw& draw) {
  const auto numbers = [&](std::size_t count) {
    std::vector<S> drawn(count);
    for (auto& x : drawn) x = static_cast<S>(draw.number());
    return drawn;
  };
  sct::Batch<S> batch;
  for (std::size_t w = 0; w < windows; ++w) {
    const std::size_t rounds = draw.between(1, architecture.context);
    const std::size_t first = draw.between(0, architecture.time_rows - rounds);
    batch.window_rounds.push_back(rounds);
    for (std::size_t t = first; t < first + rounds; ++t) batch.timesteps.push_back(static_cast<std::int32_t>(t));
  }
  const std::size_t rounds = batch.rounds();
  const std::size_t observed = rounds * architecture.agents * architecture.observation_size;
  batch.returns = numbers(rounds);
  batch.observations = numbers(observed);
  batch.opponent = random_actions<S>(architecture, rounds, draw);
  for (std::size_t i = 0; architecture.discrete && i < rounds && draw.chance(i == 0 ? 0.5 : 1); ++i) {
    std::vector<S> weights(architecture.action_size);
    S sum = 0;
    for (S& weight : weights) sum += weight = static_cast<S>(draw.between(0, 3)) + static_cast<S>(0.25);
    for (const S weight : weights) batch.belief_targets.push_back(weight / sum);
  }
  batch.own = random_actions<S>(architecture, rounds * architecture.agents, draw);
  if (draw.chance(0.5)) batch.wanted = random_actions<S>(architecture, rounds * architecture.agents, draw);
  for (std::size_t t = 0; t < rounds && draw.chance(t == 0 ? 0.5 : 1); ++t)
    batch.action_weights.push_back(static_cast<S>(draw.between(t == 0 ? 1 : 0, 3)));
  if (!architecture.auxiliary) return batch;
  batch.next_observations = numbers(observed);
  batch.next_returns = numbers(rounds);
  return batch;
}

}  // namespace folk::test
