#pragma once
// What a tournament keeps of one pair.

#include <array>
#include <cstdint>
#include <string_view>

namespace folk {

/// Expected weight of each outcome (CC, CD, DC, DD; the first player's move first) under a criterion: counts for
/// finite, expected counts for ending, (1-d)-weighted for discounted, frequencies for mean.
using OutcomeWeights = std::array<double, 4>;

/// How a figure was obtained.
enum class Method : std::uint8_t {
  cycle,    ///< exact: the play of deterministic machines, its cycle found
  markov,   ///< exact up to rounding: the pair's Markov chain
  bounded,  ///< deterministic play cut off where no cycle shows: no limit is proved
  sampled   ///< the mean of repetitions
};

constexpr std::string_view to_string(Method method) {
  switch (method) {
    case Method::cycle: return "cycle";
    case Method::markov: return "markov";
    case Method::bounded: return "bounded";
    case Method::sampled: return "sampled";
  }
  return "?";
}

/// One pair's outcomes, and for sampled ones the standard errors of both players' payoffs.
struct PairResult {
  OutcomeWeights weights{};
  double first_error = 0;
  double second_error = 0;
  Method method = Method::cycle;
};

/// The same pair with the players exchanged.
constexpr PairResult exchanged(const PairResult& pair) {
  return {{pair.weights[0], pair.weights[2], pair.weights[1], pair.weights[3]},
          pair.second_error,
          pair.first_error,
          pair.method};
}

}  // namespace folk
