#include <folk/analysis/markov_play.h>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/strong_components.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

namespace folk {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// A joint state: what happens in it, and where each outcome leads.
struct Joint {
  std::array<double, 4> probability{};
  std::array<std::uint32_t, 4> next{};
};

/// The joint states of a pair in breadth-first order, start first.
using Chain = std::vector<Joint>;

double really_cooperates(double intended, double noise) { return intended * (1 - noise) + (1 - intended) * noise; }

std::optional<Chain> joint_chain(const Automaton& first, const Automaton& second, double noise, std::size_t most) {
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> states;
  const auto number = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, fresh] =
        numbers.try_emplace((std::uint64_t{a} << 32U) | b, static_cast<std::uint32_t>(states.size()));
    if (fresh) states.emplace_back(a, b);
    return place->second;
  };
  number(static_cast<std::uint32_t>(first.start()), static_cast<std::uint32_t>(second.start()));
  Chain chain;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states.size() > most) return std::nullopt;
    const auto [a, b] = states[i];
    const double p = really_cooperates(first.nodes()[a].cooperation, noise);
    const double q = really_cooperates(second.nodes()[b].cooperation, noise);
    Joint joint{{p * q, p * (1 - q), (1 - p) * q, (1 - p) * (1 - q)}, {}};
    for (std::size_t o = 0; o < 4; ++o)
      if (joint.probability[o] > 0) {
        const std::size_t theirs = ((o & 1U) << 1U) | (o >> 1U);  // the same outcome as the second player sees it
        joint.next[o] = number(first.nodes()[a].next[o], second.nodes()[b].next[theirs]);
      }
    chain.push_back(joint);
  }
  return chain;
}

OutcomeWeights outcomes_of(const Chain& chain, const VectorXd& visits) {
  OutcomeWeights weights{};
  for (std::size_t i = 0; i < chain.size(); ++i)
    for (std::size_t o = 0; o < 4; ++o) weights[o] += visits[static_cast<Eigen::Index>(i)] * chain[i].probability[o];
  return weights;
}

/// The transposed transition matrix: column i holds where state i leads.
Sparse transposed_transitions(const Chain& chain) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < chain.size(); ++i)
    for (std::size_t o = 0; o < 4; ++o)
      if (chain[i].probability[o] > 0)
        entries.emplace_back(static_cast<int>(chain[i].next[o]), static_cast<int>(i), chain[i].probability[o]);
  const auto n = static_cast<Eigen::Index>(chain.size());
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Solves a x = b; dense while that is quick.
VectorXd solve(const Sparse& a, const VectorXd& b) {
  if (a.rows() <= 200) return MatrixXd(a).partialPivLu().solve(b);
  Eigen::SparseLU<Sparse> lu;
  lu.compute(a);
  return lu.solve(b);
}

VectorXd unit(std::size_t size, std::size_t at) {
  VectorXd vector = VectorXd::Zero(static_cast<Eigen::Index>(size));
  vector[static_cast<Eigen::Index>(at)] = 1;
  return vector;
}

OutcomeWeights round_by_round(const Chain& chain, std::uint64_t rounds) {
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
        then[chain[i].next[o]] += mass;
      }
    }
    std::swap(now, then);
  }
  return weights;
}

/// Expected visits over T rounds by doubling: sum_{t<2k} Q^t = (I + Q^k) sum_{t<k} Q^t, Q the transposed transitions.
OutcomeWeights by_doubling(const Chain& chain, std::uint64_t rounds) {
  const auto n = static_cast<Eigen::Index>(chain.size());
  MatrixXd power = transposed_transitions(chain);  // Q^(2^j)
  MatrixXd sum = MatrixXd::Identity(n, n);         // sum of Q^t for t < 2^j
  VectorXd start = unit(chain.size(), 0);          // where the rounds not yet counted begin
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

OutcomeWeights geometric(const Chain& chain, double continuation) {
  const auto n = static_cast<Eigen::Index>(chain.size());
  Sparse identity(n, n);
  identity.setIdentity();
  const Sparse system = identity - continuation * transposed_transitions(chain);
  return outcomes_of(chain, solve(system, unit(chain.size(), 0)));
}

/// The strongly connected component of each joint state.
std::vector<int> components_of(const Chain& chain, int& count) {
  using Graph = boost::compressed_sparse_row_graph<boost::directedS>;
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  for (std::size_t i = 0; i < chain.size(); ++i)
    for (std::size_t o = 0; o < 4; ++o)
      if (chain[i].probability[o] > 0) edges.emplace_back(i, chain[i].next[o]);
  const Graph graph(boost::edges_are_unsorted, edges.begin(), edges.end(), chain.size());
  std::vector<int> component(chain.size());
  count = boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(), boost::get(boost::vertex_index, graph)));
  return component;
}

/// The stationary distribution of a recurrent class (its members' numbers), as a vector over the members.
VectorXd stationary(const Chain& chain, const std::vector<std::size_t>& members) {
  std::vector<Eigen::Index> place(chain.size(), -1);
  for (std::size_t k = 0; k < members.size(); ++k) place[members[k]] = static_cast<Eigen::Index>(k);
  const auto n = static_cast<Eigen::Index>(members.size());
  // Q pi = pi with the last equation replaced by sum pi = 1.
  std::vector<Eigen::Triplet<double>> entries;
  const auto put = [&](Eigen::Index row, Eigen::Index column, double value) {
    if (row != n - 1) entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  };
  for (Eigen::Index k = 0; k < n; ++k) {
    const Joint& joint = chain[members[static_cast<std::size_t>(k)]];
    put(k, k, -1);
    for (std::size_t o = 0; o < 4; ++o)
      if (joint.probability[o] > 0) put(place[joint.next[o]], k, joint.probability[o]);
    entries.emplace_back(static_cast<int>(n - 1), static_cast<int>(k), 1.0);
  }
  Sparse system(n, n);
  system.setFromTriplets(entries.begin(), entries.end());
  return solve(system, unit(members.size(), members.size() - 1));
}

/// The probability with which play ends in each recurrent class, by the expected visits to the transient states.
std::vector<double> absorption(const Chain& chain, const std::vector<int>& component,
                               const std::vector<bool>& recurrent, std::size_t classes) {
  std::vector<double> absorbed(classes, 0.0);
  if (recurrent[static_cast<std::size_t>(component[0])]) {
    absorbed[static_cast<std::size_t>(component[0])] = 1;
    return absorbed;
  }
  std::vector<std::size_t> transient;
  std::vector<int> place(chain.size(), -1);
  for (std::size_t i = 0; i < chain.size(); ++i)
    if (!recurrent[static_cast<std::size_t>(component[i])]) {
      place[i] = static_cast<int>(transient.size());
      transient.push_back(i);
    }
  std::vector<Eigen::Triplet<double>> entries;
  for (const std::size_t i : transient) {
    entries.emplace_back(place[i], place[i], 1.0);
    for (std::size_t o = 0; o < 4; ++o)
      if (chain[i].probability[o] > 0 && place[chain[i].next[o]] >= 0)
        entries.emplace_back(place[chain[i].next[o]], place[i], -chain[i].probability[o]);
  }
  const auto n = static_cast<Eigen::Index>(transient.size());
  Sparse system(n, n);
  system.setFromTriplets(entries.begin(), entries.end());
  const VectorXd visits = solve(system, unit(transient.size(), static_cast<std::size_t>(place[0])));
  for (std::size_t k = 0; k < transient.size(); ++k)
    for (std::size_t o = 0; o < 4; ++o) {
      const Joint& joint = chain[transient[k]];
      if (joint.probability[o] > 0 && place[joint.next[o]] < 0)
        absorbed[static_cast<std::size_t>(component[joint.next[o]])] +=
            visits[static_cast<Eigen::Index>(k)] * joint.probability[o];
    }
  return absorbed;
}

OutcomeWeights long_run(const Chain& chain) {
  int count = 0;
  const std::vector<int> component = components_of(chain, count);
  const auto classes = static_cast<std::size_t>(count);
  std::vector<bool> recurrent(classes, true);
  std::vector<std::vector<std::size_t>> members(classes);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    members[static_cast<std::size_t>(component[i])].push_back(i);
    for (std::size_t o = 0; o < 4; ++o)
      if (chain[i].probability[o] > 0 && component[chain[i].next[o]] != component[i])
        recurrent[static_cast<std::size_t>(component[i])] = false;
  }
  const std::vector<double> absorbed = absorption(chain, component, recurrent, classes);
  VectorXd frequencies = VectorXd::Zero(static_cast<Eigen::Index>(chain.size()));
  for (std::size_t c = 0; c < classes; ++c) {
    if (absorbed[c] <= 0) continue;
    const VectorXd within = stationary(chain, members[c]);
    for (std::size_t k = 0; k < members[c].size(); ++k)
      frequencies[static_cast<Eigen::Index>(members[c][k])] = absorbed[c] * within[static_cast<Eigen::Index>(k)];
  }
  return outcomes_of(chain, frequencies);
}

/// Whichever way of summing T rounds is cheaper, or nothing when both cost more than `work`.
std::optional<OutcomeWeights> finite_sum(const Chain& chain, std::uint64_t rounds, std::uint64_t work) {
  const double n = static_cast<double>(chain.size());
  const double stepping = 4 * n * static_cast<double>(rounds);
  const double doubling = 2 * n * n * n * (1 + std::log2(static_cast<double>(rounds)));
  if (std::min(stepping, doubling) > static_cast<double>(work)) return std::nullopt;
  return stepping <= doubling ? round_by_round(chain, rounds) : by_doubling(chain, rounds);
}

}  // namespace

std::optional<PairResult> play_markov(const Automaton& first, const Automaton& second, double noise,
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
      pair.weights = geometric(*chain, criterion.continuation());
      for (double& weight : pair.weights) weight *= 1 - criterion.continuation();
      break;
    case Criterion::Kind::ending: pair.weights = geometric(*chain, criterion.continuation()); break;
    case Criterion::Kind::mean: pair.weights = long_run(*chain); break;
  }
  return pair;
}

}  // namespace folk
