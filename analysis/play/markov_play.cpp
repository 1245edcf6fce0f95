#include <folk/analysis/play/markov_chain.h>
#include <folk/analysis/play/markov_play.h>
#include <folk/analysis/play/state_reduction.h>
#include <folk/strategies/product.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace folk {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The joint states of a pair in breadth-first order, start first.
std::optional<MarkovChain> joint_chain(const Automaton& first, const Automaton& second, Noise noise, std::size_t most) {
  const auto joint_states = product(first, second, noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own, most);
  if (!joint_states) return std::nullopt;
  MarkovChain chain;
  chain.reserve(joint_states->size());
  for (const JointNode& node : *joint_states) {
    const auto p = really_played(first.nodes()[node.first].cooperation, noise);
    const auto q = really_played(second.nodes()[node.second].cooperation, noise);
    chain.push_back({{p[0] * q[0], p[0] * q[1], p[1] * q[0], p[1] * q[1]}, node.next});
  }
  return chain;
}

OutcomeWeights outcomes_of(const MarkovChain& chain, const VectorXd& visits) {
  OutcomeWeights weights{};
  for (std::size_t i = 0; i < chain.size(); ++i)
    for (std::size_t o = 0; o < 4; ++o) weights[o] += visits[static_cast<Eigen::Index>(i)] * chain[i].probability[o];
  return weights;
}

Transitions transitions(const MarkovChain& chain) {
  const auto n = static_cast<Eigen::Index>(chain.size());
  Transitions matrix = Transitions::Zero(n, n);
  for (std::size_t i = 0; i < chain.size(); ++i)
    for (std::size_t o = 0; o < 4; ++o)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(chain[i].next[o])) += chain[i].probability[o];
  return matrix;
}

VectorXd unit(std::size_t size, std::size_t at) {
  VectorXd vector = VectorXd::Zero(static_cast<Eigen::Index>(size));
  vector[static_cast<Eigen::Index>(at)] = 1;
  return vector;
}

/// Round t weighs continuation^t.
OutcomeWeights round_by_round(const MarkovChain& chain, std::uint64_t rounds, double continuation = 1) {
  std::vector<double> now(chain.size());
  std::vector<double> then(chain.size());
  OutcomeWeights weights{};
  now[0] = 1;
  for (std::uint64_t t = 0; t < rounds; ++t) {
    std::fill(then.begin(), then.end(), 0.0);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (now[i] == 0) continue;
      for (std::size_t o = 0; o < 4; ++o) {
        const double mass = now[i] * chain[i].probability[o];
        weights[o] += mass;
        then[chain[i].next[o]] += continuation * mass;
      }
    }
    std::swap(now, then);
  }
  return weights;
}

/// Expected visits over T rounds by doubling: sum_{t<2k} Q^t = (I + Q^k) sum_{t<k} Q^t, Q the transposed transitions.
OutcomeWeights by_doubling(const MarkovChain& chain, std::uint64_t rounds) {
  const auto n = static_cast<Eigen::Index>(chain.size());
  MatrixXd power = transitions(chain).transpose();  // Q^(2^j)
  MatrixXd sum = MatrixXd::Identity(n, n);          // sum of Q^t for t < 2^j
  VectorXd start = unit(chain.size(), 0);           // where the rounds not yet counted begin
  VectorXd visits = VectorXd::Zero(n);
  for (std::uint64_t left = rounds; left > 0; left >>= 1U) {
    if ((left & 1U) != 0) {
      visits += sum * start;
      start = power * start;
    }
    if (left > 1) {
      sum += power * sum;
      power = power * power;
      // Columns are distributions: scaling keeps rounding from growing with 2^j.
      for (Eigen::Index c = 0; c < n; ++c) power.col(c) /= power.col(c).sum();
    }
  }
  return outcomes_of(chain, visits);
}

/// Expected discounted outcomes, as weights that add up to 1: the stationary distribution of the chain that starts anew
/// after each round with probability `stopping`.
OutcomeWeights restarted(const MarkovChain& chain, const Criterion& criterion) {
  Transitions restart = criterion.continuation() * transitions(chain);
  restart.col(0).array() += criterion.stopping();
  return outcomes_of(chain, stationary_distribution(std::move(restart)));
}

/// The same, solved at once where that is quick, else round by round until at most 1e-17 is left.
std::optional<OutcomeWeights> discounted_share(const MarkovChain& chain, const Criterion& criterion,
                                               const MarkovLimits& limits) {
  if (chain.size() <= limits.solved_states) return restarted(chain, criterion);
  const double rounds = criterion.rounds_until_left(1e-17);
  if (4 * rounds * static_cast<double>(chain.size()) > static_cast<double>(limits.work)) return std::nullopt;
  OutcomeWeights weights = round_by_round(chain, static_cast<std::uint64_t>(rounds), criterion.continuation());
  for (double& weight : weights) weight *= criterion.stopping();
  return weights;
}

/// The place of each member among the members, -1 for others.
std::vector<Eigen::Index> places_of(const std::vector<std::size_t>& members, std::size_t size) {
  std::vector<Eigen::Index> place(size, -1);
  for (std::size_t k = 0; k < members.size(); ++k) place[members[k]] = static_cast<Eigen::Index>(k);
  return place;
}

/// The stationary distribution of a recurrent class, over its members.
VectorXd stationary(const MarkovChain& chain, const std::vector<std::size_t>& members) {
  const auto place = places_of(members, chain.size());
  const auto n = static_cast<Eigen::Index>(members.size());
  Transitions within = Transitions::Zero(n, n);
  for (const std::size_t i : members)
    for (std::size_t o = 0; o < 4; ++o)
      if (chain[i].probability[o] > 0) within(place[i], place[chain[i].next[o]]) += chain[i].probability[o];
  return stationary_distribution(std::move(within));
}

/// The probability with which play ends in each component.
std::vector<double> absorption(const MarkovChain& chain, const ChainClasses& classes) {
  std::vector<double> absorbed(classes.members.size(), 0.0);
  if (classes.recurrent[classes.of[0]]) {
    absorbed[classes.of[0]] = 1;
    return absorbed;
  }
  std::vector<std::size_t> transient;
  for (std::size_t i = 0; i < chain.size(); ++i)
    if (!classes.recurrent[classes.of[i]]) transient.push_back(i);
  const auto place = places_of(transient, chain.size());
  const auto n = static_cast<Eigen::Index>(transient.size());
  Transitions moves = Transitions::Zero(n, n + static_cast<Eigen::Index>(absorbed.size()));
  for (const std::size_t i : transient)
    for (std::size_t o = 0; o < 4; ++o) {
      const std::size_t next = chain[i].next[o];
      if (chain[i].probability[o] > 0)
        moves(place[i], place[next] >= 0 ? place[next] : n + static_cast<Eigen::Index>(classes.of[next])) +=
            chain[i].probability[o];
    }
  const VectorXd ends = absorption_probabilities(std::move(moves));
  for (std::size_t c = 0; c < absorbed.size(); ++c) absorbed[c] = ends[static_cast<Eigen::Index>(c)];
  return absorbed;
}

OutcomeWeights long_run(const MarkovChain& chain) {
  const ChainClasses classes = classes_of(chain);
  const std::vector<double> absorbed = absorption(chain, classes);
  VectorXd frequencies = VectorXd::Zero(static_cast<Eigen::Index>(chain.size()));
  for (std::size_t c = 0; c < absorbed.size(); ++c) {
    if (absorbed[c] <= 0) continue;
    const auto& members = classes.members[c];
    const VectorXd within = stationary(chain, members);
    for (std::size_t k = 0; k < members.size(); ++k)
      frequencies[static_cast<Eigen::Index>(members[k])] = absorbed[c] * within[static_cast<Eigen::Index>(k)];
  }
  return outcomes_of(chain, frequencies);
}

/// Whichever way of summing T rounds is cheaper, or nothing when both cost more than `work`.
std::optional<OutcomeWeights> finite_sum(const MarkovChain& chain, std::uint64_t rounds, std::uint64_t work) {
  const double n = static_cast<double>(chain.size());
  const double stepping = 4 * n * static_cast<double>(rounds);
  const double doubling = 2 * n * n * n * (1 + std::log2(static_cast<double>(rounds)));
  if (std::min(stepping, doubling) > static_cast<double>(work)) return std::nullopt;
  return stepping <= doubling ? round_by_round(chain, rounds) : by_doubling(chain, rounds);
}

}  // namespace

std::optional<PairResult> play_markov(const Automaton& first, const Automaton& second, Noise noise,
                                      const Criterion& criterion, const MarkovLimits& limits) {
  const auto chain = joint_chain(first, second, noise, limits.joint_states);
  if (!chain) return std::nullopt;
  PairResult pair;
  pair.method = Method::markov;
  switch (criterion.kind()) {
    case Criterion::Kind::finite: {
      const auto weights = finite_sum(*chain, criterion.rounds(), limits.work);
      if (!weights) return std::nullopt;
      pair.weights = *weights;
      break;
    }
    case Criterion::Kind::discounted:
    case Criterion::Kind::ending: {
      const auto share = discounted_share(*chain, criterion, limits);
      if (!share) return std::nullopt;
      pair.weights = *share;
      for (double& weight : pair.weights) weight *= criterion.total_weight();
      break;
    }
    case Criterion::Kind::mean:
      if (chain->size() > limits.solved_states) return std::nullopt;
      pair.weights = long_run(*chain);
      break;
  }
  return pair;
}

}  // namespace folk
