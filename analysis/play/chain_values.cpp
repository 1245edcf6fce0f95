#include <folk/analysis/play/chain_values.h>
#include <folk/analysis/play/state_reduction.h>
#include <folk/games/error.h>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Multiplications that sweeping may take.
constexpr double most_work = 4e9;

void solve_at_once(const MarkovChain& chain, const std::vector<double>& rewards, const Criterion& criterion,
                   std::vector<double>& values) {
  const auto n = static_cast<Index>(chain.size());
  MatrixXd left = MatrixXd::Identity(n, n);
  VectorXd right(n);
  for (Index i = 0; i < n; ++i) {
    const auto& state = chain[static_cast<std::size_t>(i)];
    for (std::size_t o = 0; o < 4; ++o)
      left(i, static_cast<Index>(state.next[o])) -= criterion.continuation() * state.probability[o];
    right[i] = first_weight(criterion) * rewards[static_cast<std::size_t>(i)];
  }
  const VectorXd solution = left.partialPivLu().solve(right);
  std::copy(solution.begin(), solution.end(), values.begin());
}

/// Gain and bias of a recurrent class, by its stationary distribution; the bias is 0 in its first member.
void solve_class(const MarkovChain& chain, const std::vector<double>& rewards, const std::vector<std::size_t>& members,
                 GainAndBias& answer) {
  const auto n = static_cast<Index>(members.size());
  std::vector<Index> place(chain.size(), -1);
  for (Index k = 0; k < n; ++k) place[members[static_cast<std::size_t>(k)]] = k;
  Transitions within = Transitions::Zero(n, n);
  VectorXd reward(n);
  for (Index k = 0; k < n; ++k) {
    const std::size_t i = members[static_cast<std::size_t>(k)];
    reward[k] = rewards[i];
    for (std::size_t o = 0; o < 4; ++o)
      if (chain[i].probability[o] > 0) within(k, place[chain[i].next[o]]) += chain[i].probability[o];
  }
  const double gain = stationary_distribution(within).dot(reward);
  // (I - P) h = r - g with h = 0 in the first state: its column and row are left out.
  VectorXd bias = VectorXd::Zero(n);
  if (n > 1) {
    MatrixXd rest = -within.bottomRightCorner(n - 1, n - 1);
    for (Index k = 1; k < n; ++k)  // what leaves a state is summed, not 1 - P(k, k)
      rest(k - 1, k - 1) = within.row(k).head(k).sum() + within.row(k).tail(n - 1 - k).sum();
    const VectorXd excess = reward.tail(n - 1).array() - gain;
    bias.tail(n - 1) = rest.partialPivLu().solve(excess);
  }
  for (Index k = 0; k < n; ++k) {
    answer.gain[members[static_cast<std::size_t>(k)]] = gain;
    answer.bias[members[static_cast<std::size_t>(k)]] = bias[k];
  }
}

/// Gain and bias of the transient states, once those of the recurrent ones are known. Gains are found without a
/// subtraction: whether two of them are equal decides between moves.
void solve_transient(const MarkovChain& chain, const std::vector<double>& rewards,
                     const std::vector<std::size_t>& transient, GainAndBias& answer) {
  if (transient.empty()) return;
  const auto n = static_cast<Index>(transient.size());
  std::vector<Index> place(chain.size(), -1);
  for (Index k = 0; k < n; ++k) place[transient[static_cast<std::size_t>(k)]] = k;
  Transitions moves = Transitions::Zero(n, n + 1);
  VectorXd ends = VectorXd::Zero(n);
  VectorXd bias = VectorXd::Zero(n);
  for (Index k = 0; k < n; ++k) {
    const std::size_t i = transient[static_cast<std::size_t>(k)];
    for (std::size_t o = 0; o < 4; ++o) {
      const double p = chain[i].probability[o];
      const std::size_t next = chain[i].next[o];
      if (p <= 0) continue;
      moves(k, place[next] >= 0 ? place[next] : n) += p;
      if (place[next] >= 0) continue;
      ends[k] += p * answer.gain[next];
      bias[k] += p * answer.bias[next];
    }
    if (moves(k, n) > 0) ends[k] /= moves(k, n);
    bias[k] += rewards[i];
  }
  const VectorXd gain = expected_ends(moves, ends);
  MatrixXd left = -moves.leftCols(n);
  for (Index k = 0; k < n; ++k) left(k, k) = moves.row(k).head(k).sum() + moves.row(k).tail(n - k).sum();
  bias = left.partialPivLu().solve(bias - gain).eval();
  for (Index k = 0; k < n; ++k) {
    answer.gain[transient[static_cast<std::size_t>(k)]] = gain[k];
    answer.bias[transient[static_cast<std::size_t>(k)]] = bias[k];
  }
}

}  // namespace

double first_weight(const Criterion& criterion) {
  return criterion.kind() == Criterion::Kind::discounted ? criterion.stopping() : 1;
}

double sweep(const MarkovChain& chain, const std::vector<double>& rewards, const Criterion& criterion,
             std::vector<double>& values) {
  const double d = criterion.continuation();
  const double weight = first_weight(criterion);
  double change = 0;
  for (std::size_t i = chain.size(); i-- > 0;) {
    double after = 0;
    for (std::size_t o = 0; o < 4; ++o) after += chain[i].probability[o] * values[chain[i].next[o]];
    const double value = weight * rewards[i] + d * after;
    change = std::max(change, std::abs(value - values[i]));
    values[i] = value;
  }
  return change;
}

void solve_discounted(const MarkovChain& chain, const std::vector<double>& rewards, const Criterion& criterion,
                      std::vector<double>& values) {
  const auto n = static_cast<double>(chain.size());
  const double sweeping = 4 * n * 40 / criterion.stopping();
  const bool at_once = chain.size() <= most_solved_states && n * n * n / 1.5 < 8 * sweeping;
  if (at_once) {
    solve_at_once(chain, rewards, criterion, values);
    return;
  }
  if (sweeping > most_work)
    throw UsageError(fmt::format("{} states at {}: too many to solve, take fewer states or less patience", chain.size(),
                                 criterion.to_string()));
  double largest = 0;
  for (const double reward : rewards) largest = std::max(largest, std::abs(reward));
  const double enough = 0x1p-52 * largest * first_weight(criterion);
  const auto most = static_cast<std::uint64_t>(60 / criterion.stopping()) + 100;
  for (std::uint64_t i = 0; i < most && sweep(chain, rewards, criterion, values) > enough; ++i) continue;
}

GainAndBias solve_mean(const MarkovChain& chain, const std::vector<double>& rewards) {
  if (chain.size() > most_solved_states)
    throw UsageError(fmt::format("a mean over {} states that chance connects: more than the {} that are solved at once",
                                 chain.size(), most_solved_states));
  const ChainClasses classes = classes_of(chain);
  GainAndBias answer{std::vector<double>(chain.size()), std::vector<double>(chain.size())};
  std::vector<std::size_t> transient;
  for (std::size_t c = 0; c < classes.members.size(); ++c)
    if (classes.recurrent[c])
      solve_class(chain, rewards, classes.members[c], answer);
    else
      transient.insert(transient.end(), classes.members[c].begin(), classes.members[c].end());
  solve_transient(chain, rewards, transient, answer);
  return answer;
}

}  // namespace folk
