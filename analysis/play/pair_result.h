#pragma once
// What a tournament keeps of one pair.

#include <folk/games/criterion.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace folk {

/// Expected weight of each outcome (CC, CD, DC, DD; the first player's move first) under a criterion: counts for
/// finite, expected counts for ending, (1-d)-weighted for discounted, frequencies for mean.
using OutcomeWeights = std::array<double, 4>;

/// How a figure was obtained, from the most exact to the least.
enum class Method : std::uint8_t {
  cycle,    ///< exact: the play of deterministic machines, its cycle found
  played,   ///< one match of deterministic players, which is all there is
  markov,   ///< exact up to rounding: the pair's Markov chain
  bounded,  ///< deterministic play cut off where no cycle shows: no limit is proved
  sampled   ///< the mean of repetitions
};

constexpr std::string_view to_string(Method method) {
  switch (method) {
    case Method::cycle: return "cycle";
    case Method::played: return "played";
    case Method::markov: return "markov";
    case Method::bounded: return "bounded";
    case Method::sampled: return "sampled";
  }
  return "?";
}

/// True for figures without any rounding: sums of finitely many payoffs.
inline bool is_exact(Method method, const Criterion& criterion) {
  return criterion.is_finite() && method <= Method::played;
}

/// How often a player's likelier guess of the other's move was right, and how much it had expected the move that came.
/// Rounds weigh as they do in the outcomes, so that the first two are counts for finite.
struct Guesses {
  double right = 0;
  double all = 0;       ///< 0 for a player without beliefs
  double log_loss = 0;  ///< - sum of ln(probability given to the move that was played); infinite after a surprise

  Guesses& operator+=(const Guesses& more) {
    right += more.right;
    all += more.all;
    log_loss += more.log_loss;
    return *this;
  }
  Guesses& operator/=(double count) {
    right /= count;
    all /= count;
    log_loss /= count;
    return *this;
  }

  /// The share that was right; nothing without a guess.
  std::optional<double> accuracy() const { return share(right); }
  /// The mean natural log loss, nothing clipped; nothing without a guess.
  std::optional<double> mean_log_loss() const { return share(log_loss); }

private:
  std::optional<double> share(double part) const { return all > 0 ? std::optional(part / all) : std::nullopt; }
};

/// One pair's outcomes, and for played ones the standard errors of both players' payoffs and their guesses.
struct PairResult {
  OutcomeWeights weights{};
  double first_error = 0;
  double second_error = 0;
  Method method = Method::cycle;
  Guesses first_guesses{};
  Guesses second_guesses{};
};

/// The same pair with the players exchanged.
constexpr PairResult exchanged(const PairResult& pair) {
  return {{pair.weights[0], pair.weights[2], pair.weights[1], pair.weights[3]},
          pair.second_error,
          pair.first_error,
          pair.method,
          pair.second_guesses,
          pair.first_guesses};
}

}  // namespace folk
