#include <folk/analysis/play/chain_values.h>
#include <folk/analysis/replies/markov_reply.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace folk {
namespace {

/// Both moves in every state as rows of a chain, with their expected rewards.
class Choices {
public:
  explicit Choices(const ReplyProblem& problem)
      : size_(problem.size()) {
    const auto payoffs = problem.payoffs.numbers();
    for (const Move own : {Move::C, Move::D}) {
      rows_[bit(own)].resize(size_);
      rewards_[bit(own)].resize(size_);
    }
    for (std::size_t s = 0; s < size_; ++s)
      for (const Move own : {Move::C, Move::D}) {
        ChainState& row = rows_[bit(own)][s];
        double& reward = rewards_[bit(own)][s];
        if (problem.is_outside(s)) {
          row.probability[0] = 1;
          row.next[0] = static_cast<std::uint32_t>(s);
          reward = to_double(problem.outside->payoff);
          continue;
        }
        for (const auto& [outcome, chance] : problem.after(s, own)) {
          const std::size_t o = outcome.index();
          row.probability[o] = chance;
          row.next[o] = problem.states[s].next[o];
          reward += chance * payoffs[o];
        }
      }
  }

  std::size_t size() const { return size_; }
  double reward(std::size_t s, Move own) const { return rewards_[bit(own)][s]; }

  double mean_of(std::size_t s, Move own, const std::vector<double>& values) const {
    const ChainState& row = rows_[bit(own)][s];
    double mean = 0;
    for (std::size_t o = 0; o < 4; ++o)
      if (row.probability[o] > 0) mean += row.probability[o] * values[row.next[o]];
    return mean;
  }

  /// The chain and the rewards that these moves make.
  void follow(const std::vector<Move>& moves, MarkovChain& chain, std::vector<double>& rewards) const {
    chain.resize(size_);
    rewards.resize(size_);
    for (std::size_t s = 0; s < size_; ++s) {
      chain[s] = rows_[bit(moves[s])][s];
      rewards[s] = reward(s, moves[s]);
    }
  }

  double largest_reward() const {
    double largest = 0;
    for (const auto& rewards : rewards_)
      for (const double reward : rewards) largest = std::max(largest, std::abs(reward));
    return largest;
  }

private:
  std::size_t size_;
  std::array<MarkovChain, 2> rows_;
  std::array<std::vector<double>, 2> rewards_;
};

/// No improvement is taken below this share of what a round can pay: rounding would make policies take turns.
constexpr double least_improvement = 1e-13;

StationaryReply discounted_reply(const Choices& choices, const Criterion& criterion) {
  const double weight = first_weight(criterion);
  const double d = criterion.continuation();
  const auto worth = [&](std::size_t s, Move own, const std::vector<double>& values) {
    return weight * choices.reward(s, own) + d * choices.mean_of(s, own, values);
  };
  std::vector<Move> moves(choices.size(), Move::C);
  std::vector<double> values(choices.size(), 0);
  MarkovChain chain;
  std::vector<double> rewards;
  const double least = least_improvement * choices.largest_reward() * criterion.total_weight();
  const auto improve = [&] {
    bool better = false;
    for (std::size_t s = 0; s < choices.size(); ++s) {
      const Move instead = other(moves[s]);
      if (worth(s, instead, values) > worth(s, moves[s], values) + least) {
        moves[s] = instead;
        better = true;
      }
    }
    return better;
  };
  // A few sweeps are enough to choose by; only the last policies are solved.
  constexpr int rough_steps = 60;
  constexpr int sweeps_between = 20;
  for (int step = 0; step < rough_steps; ++step) {
    if (!improve() && step > 0) break;
    choices.follow(moves, chain, rewards);
    for (int i = 0; i < sweeps_between; ++i) sweep(chain, rewards, criterion, values);
  }
  // Values rise from policy to policy. Where they no longer do, rounding alone would make policies take turns for ever.
  double best = -std::numeric_limits<double>::infinity();
  do {
    choices.follow(moves, chain, rewards);
    solve_discounted(chain, rewards, criterion, values);
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    if (!(sum > best)) break;
    best = sum;
  } while (improve());
  StationaryReply reply{moves, values, 0, std::nullopt, {}};
  double change = 0;
  for (std::size_t s = 0; s < choices.size(); ++s)
    change = std::max(change, std::abs(std::max(worth(s, Move::C, values), worth(s, Move::D, values)) - values[s]));
  // The equation itself is rounded too: a few units of the last digit of what stands in it.
  double largest = weight * choices.largest_reward();
  for (const double value : values) largest = std::max(largest, std::abs(value));
  reply.residual = (change + 8 * 0x1p-53 * largest) / criterion.stopping();
  return reply;
}

/// Takes every better gain, else every better bias (Howard 1960). `left` becomes the largest improvement of the bias
/// that was not worth taking. False where none was taken.
bool improve_mean(const Choices& choices, const GainAndBias& values, std::vector<Move>& moves, double& left) {
  const double least_gain = least_improvement * choices.largest_reward();
  double largest = choices.largest_reward();
  for (const double bias : values.bias) largest = std::max(largest, std::abs(bias));
  const double least_bias = least_improvement * largest;
  left = least_bias;
  bool better = false;
  for (std::size_t s = 0; s < choices.size(); ++s)
    if (choices.mean_of(s, other(moves[s]), values.gain) > values.gain[s] + least_gain) {
      moves[s] = other(moves[s]);
      better = true;
    }
  if (better) return true;
  for (std::size_t s = 0; s < choices.size(); ++s) {
    const Move instead = other(moves[s]);
    if (choices.mean_of(s, instead, values.gain) < values.gain[s] - least_gain) continue;
    const double after = choices.reward(s, instead) - values.gain[s] + choices.mean_of(s, instead, values.bias);
    if (after > values.bias[s] + least_bias) {
      left = std::max(left, after - values.bias[s]);
      moves[s] = instead;
      better = true;
    }
  }
  return better;
}

StationaryReply mean_reply(const Choices& choices) {
  // A dozen is much. More come only of rounding, which makes policies take turns; `left` then says what it hides.
  constexpr int most_policies = 200;
  std::vector<Move> moves(choices.size(), Move::C);
  std::vector<Move> improved = moves;
  MarkovChain chain;
  std::vector<double> rewards;
  GainAndBias values;
  double left = 0;
  bool better = true;
  for (int policies = 0; better && policies < most_policies; ++policies) {
    moves = improved;
    choices.follow(moves, chain, rewards);
    values = solve_mean(chain, rewards);
    better = improve_mean(choices, values, improved, left);
  }
  return {std::move(moves), std::move(values.gain), left, std::nullopt, {}};
}

}  // namespace

StationaryReply markov_reply(const ReplyProblem& problem, const Criterion& criterion) {
  if (criterion.is_finite()) throw std::logic_error("a stationary reply is none to a match that ends");
  const Choices choices(problem);
  return criterion.kind() == Criterion::Kind::mean ? mean_reply(choices) : discounted_reply(choices, criterion);
}

}  // namespace folk
