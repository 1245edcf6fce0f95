#include <folk/analysis/deterministic_play.h>
#include <folk/analysis/sampled_play.h>
#include <folk/games/error.h>
#include <folk/games/match.h>
#include <folk/games/random.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk {
namespace {

/// Rounds of one match; for ending:p drawn from the geometric distribution.
std::uint64_t length_of_match(const Criterion& criterion, const RandomKey& key) {
  switch (criterion.kind()) {
    case Criterion::Kind::finite: return criterion.rounds();
    case Criterion::Kind::mean: return long_run_rounds;
    case Criterion::Kind::discounted:
      return static_cast<std::uint64_t>(std::ceil(std::log(1e-12) / std::log(criterion.continuation())));
    case Criterion::Kind::ending: break;
  }
  if (criterion.continuation() == 0) return 1;
  const double u = RandomStream(key).uniform();
  return 1 + static_cast<std::uint64_t>(std::log1p(-u) / std::log(criterion.continuation()));
}

/// Rounds that all matches take, about.
double expected_rounds(const Sampling& sampling) {
  const double a_match = sampling.criterion.kind() == Criterion::Kind::ending
                             ? sampling.criterion.total_weight()
                             : static_cast<double>(length_of_match(sampling.criterion, {}));
  return a_match * static_cast<double>(sampling.repetitions);
}

/// Mean and standard error of what is added (Welford 1962).
class Moments {
public:
  void add(double x) {
    ++count_;
    const double before = x - mean_;
    mean_ += before / count_;
    squares_ += before * (x - mean_);
  }
  double standard_error() const { return count_ > 1 ? std::sqrt(squares_ / (count_ - 1) / count_) : 0; }

private:
  double count_ = 0;
  double mean_ = 0;
  double squares_ = 0;
};

}  // namespace

PairResult play_sampled(const Strategy& first, const Strategy& second, std::uint64_t pair, const Sampling& sampling) {
  if (expected_rounds(sampling) > static_cast<double>(most_steps))
    throw UsageError(fmt::format("{} repetitions under {} are more than {} rounds: give fewer", sampling.repetitions,
                                 sampling.criterion.to_string(), most_steps));
  const auto payoffs = sampling.payoffs.by_outcome();
  std::array<double, 4> own{};
  for (std::size_t o = 0; o < 4; ++o) own[o] = to_double(payoffs[o]);
  const std::array<double, 4> theirs{own[0], own[2], own[1], own[3]};
  const auto player_a = first.new_player();
  const auto player_b = second.new_player();
  const double continuation =
      sampling.criterion.kind() == Criterion::Kind::discounted ? sampling.criterion.continuation() : 1;
  double scale = 1;
  if (sampling.criterion.kind() == Criterion::Kind::discounted) scale = 1 - continuation;
  if (sampling.criterion.kind() == Criterion::Kind::mean) scale = 1.0 / static_cast<double>(long_run_rounds);

  PairResult result{{}, 0, 0, Method::sampled};
  Moments first_payoff;
  Moments second_payoff;
  for (std::uint64_t r = 0; r < sampling.repetitions; ++r) {
    const auto key = [&](std::uint64_t role) { return RandomKey{sampling.seed, pair, r, role}; };
    player_a->start({sampling.payoffs, sampling.criterion, key(0)});
    player_b->start({sampling.payoffs, sampling.criterion, key(1)});
    RandomStream noise(key(2));
    OutcomeWeights weights{};
    double weight = scale;
    play_match(
        *player_a, *player_b, length_of_match(sampling.criterion, key(3)),
        [&] { return sampling.noise > 0 && noise.chance(sampling.noise); },
        [&](Move a, Move b) {
          weights[outcome(a, b)] += weight;
          weight *= continuation;
        });
    double a = 0;
    double b = 0;
    for (std::size_t o = 0; o < 4; ++o) {
      result.weights[o] += weights[o];
      a += own[o] * weights[o];
      b += theirs[o] * weights[o];
    }
    first_payoff.add(a);
    second_payoff.add(b);
  }
  for (double& weight : result.weights) weight /= static_cast<double>(sampling.repetitions);
  result.first_error = first_payoff.standard_error();
  result.second_error = second_payoff.standard_error();
  return result;
}

}  // namespace folk
