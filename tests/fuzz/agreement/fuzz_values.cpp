// Play that has one course, valued twice: Flow in rationals, and solve_discounted or solve_mean on the same course as a
// chain. Values agree to 1e-9 of the criterion's weight a unit of payoff, and Flow's gains are differences of its
// values exactly.

#include <folk/analysis/play/chain_values.h>
#include <folk/analysis/replies/flow.h>

#include <cmath>
#include <utility>
#include <vector>

#include "fuzz.h"
#include "machine_bytes.h"

namespace {

using folk::Criterion;
using folk::Rational;
using folk::fuzz::require;

constexpr int scale = 3;  // payoffs are thirds

Criterion criterion(folk::fuzz::Bytes& bytes) {
  const std::uint32_t kind = bytes.below(3);
  const std::uint32_t number = bytes.next();
  switch (kind) {
    case 0: return Criterion::mean();
    case 1: return Criterion::discounted(Rational(1 + number, 257));
    default: return Criterion::ending(Rational(1, 1 + number * number));
  }
}

std::vector<double> by_chain(const std::vector<std::uint32_t>& next, const std::vector<double>& rewards,
                             const Criterion& criterion) {
  folk::MarkovChain chain;
  for (const std::uint32_t to : next) chain.push_back({{1, 0, 0, 0}, {to, to, to, to}});
  std::vector<double> payoffs;
  for (const double reward : rewards) payoffs.push_back(reward / scale);
  if (criterion.kind() == Criterion::Kind::mean) return folk::solve_mean(chain, payoffs).gain;
  std::vector<double> values(chain.size());
  folk::solve_discounted(chain, payoffs, criterion, values);
  return values;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  folk::fuzz::Bytes bytes(data, size);
  const Criterion how = criterion(bytes);
  const std::uint32_t states = 1 + bytes.below(10);
  std::vector<std::uint32_t> next;
  std::vector<double> rewards;
  for (std::uint32_t s = 0; s < states; ++s) {
    next.push_back(bytes.below(states));
    rewards.push_back(static_cast<double>(bytes.below(16)) - 5);
  }
  const double tolerance = 1e-9 * how.total_weight();
  const auto values = by_chain(next, rewards, how);
  const folk::Flow flow(next, rewards, scale, how);
  for (std::uint32_t s = 0; s < states; ++s) {
    const double exact = folk::to_double(flow.value(s));
    require(std::abs(exact - flow.values()[s]) <= flow.doubt());
    require(std::abs(exact - values[s]) <= tolerance);
  }

  const std::uint32_t state = bytes.below(states);
  const std::uint32_t instead = bytes.below(states);
  const int reward = static_cast<int>(bytes.below(16)) - 5;
  const bool mean = how.kind() == Criterion::Kind::mean;
  const Rational weight =
      how.kind() == Criterion::Kind::discounted ? Rational(1 - how.exact_continuation()) : Rational(1);
  const Rational after =
      mean ? flow.value(instead) : Rational(weight * reward / scale + how.exact_continuation() * flow.value(instead));
  const Rational gain = after - flow.value(state);
  require(flow.gain(state, reward, instead) == gain);
  require(flow.gain_sign(state, reward, instead) == gain.sign());
  require(std::abs(flow.rounded_gain(state, reward, instead) - folk::to_double(gain)) <= flow.doubt());
  return 0;
}
