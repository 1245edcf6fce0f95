#pragma once
// Small trained networks of Harper et al. (PLoS ONE 12(12), 2017): C where one layer of rectified units says so.

#include <folk/strategies/axelrod/record.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace folk {

struct NetworkWeights {
  std::size_t hidden;
  std::vector<double> values;
};

const NetworkWeights& evolved_ann_weights();
const NetworkWeights& evolved_ann_5_weights();
const NetworkWeights& evolved_ann_noise_05_weights();

/// What it sees: their first two, its last two and their last two moves, each as two numbers (whether C, whether D;
/// both 0 before there is one), then how often they played C and D, how often it did, and the rounds played.
/// While the first unit is off the others' values are cut to whole numbers: so they play in Axelrod-Python, whose
/// rectifier gives all of them the type of its first result.
template <const NetworkWeights& (*weights)()>
class EvolvedNetwork {
public:
  Move move() const {
    const auto& [hidden, values] = weights();
    const auto inputs = features();
    const double* const output = values.data() + inputs.size() * hidden;
    double sum = 0;
    bool whole = false;
    for (std::size_t unit = 0; unit < hidden; ++unit) {
      double activation = output[hidden + unit];
      for (std::size_t i = 0; i < inputs.size(); ++i) activation += values[unit * inputs.size() + i] * inputs[i];
      if (unit == 0) whole = activation < 0;
      activation = std::max(activation, 0.0);
      sum += (whole ? std::trunc(activation) : activation) * output[unit];
    }
    return sum > 0 ? Move::C : Move::D;
  }
  void observe(Move own, Move theirs) { record_.add(own, theirs); }

private:
  std::array<double, 17> features() const {
    std::array<double, 17> seen{};
    const std::size_t rounds = record_.rounds();
    const auto see = [&](std::size_t place, Move move) { seen[2 * place + bit(move)] = 1; };
    for (std::size_t i = 0; i < 2 && i < rounds; ++i) {
      see(i, record_.theirs[i]);
      see(2 + i, record_.own[rounds - 1 - i]);
      see(4 + i, record_.theirs[rounds - 1 - i]);
    }
    const std::array counts{record_.theirs.cooperations(), record_.theirs.defections(), record_.own.cooperations(),
                            record_.own.defections(), rounds};
    std::transform(counts.begin(), counts.end(), seen.begin() + 12,
                   [](std::size_t count) { return static_cast<double>(count); });
    return seen;
  }

  Record record_;
};

}  // namespace folk
