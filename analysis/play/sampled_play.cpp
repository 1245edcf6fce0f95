#include <folk/analysis/play/played_match.h>
#include <folk/analysis/play/sampled_play.h>
#include <folk/games/outcome.h>

#include <array>
#include <cmath>

namespace folk {
namespace {

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

/// The matches of one contest added up.
class ContestTally {
public:
  void add(const PlayedMatch& match, const std::array<double, 4>& payoffs) {
    double first = 0;
    double second = 0;
    const OutcomeWeights weights = match.weights();
    for (const Outcome outcome : all_outcomes) {
      const double weight = weights[outcome.index()];
      sum_.weights[outcome.index()] += weight;
      first += payoffs[outcome.index()] * weight;
      second += payoffs[outcome.exchanged().index()] * weight;
    }
    first_payoff_.add(first);
    second_payoff_.add(second);
    sum_.first_guesses += match.guesses(Seat::first);
    sum_.second_guesses += match.guesses(Seat::second);
    ++matches_;
  }

  PairResult result(Method method) const {
    PairResult mean = sum_;
    for (double& weight : mean.weights) weight /= matches_;
    mean.first_guesses /= matches_;
    mean.second_guesses /= matches_;
    mean.first_error = first_payoff_.standard_error();
    mean.second_error = second_payoff_.standard_error();
    mean.method = method;
    return mean;
  }

private:
  PairResult sum_;
  Moments first_payoff_;
  Moments second_payoff_;
  double matches_ = 0;
};

/// Adds matches up by contest.
class Tallies {
public:
  using Sheet = PlayedMatch;

  Tallies(std::size_t contests, const MatchRules& rules)
      : criterion_(rules.criterion),
        payoffs_(rules.payoffs.numbers()),
        tallies_(contests) {}

  PlayedMatch begin(const SeatedMatch& match) const { return {match.contest(), criterion_}; }
  void end(const SeatedMatch& match, const PlayedMatch& played) {
    tallies_[match.contest_number()].add(played, payoffs_);
  }

  PairResult result(std::size_t contest, Method method) const { return tallies_[contest].result(method); }

private:
  Criterion criterion_;
  std::array<double, 4> payoffs_;
  std::vector<ContestTally> tallies_;
};

Method method_of(const Contest& contest, const Criterion& criterion) {
  if (!contest.once) return Method::sampled;
  return criterion.kind() == Criterion::Kind::mean ? Method::bounded : Method::played;
}

}  // namespace

std::vector<PairResult> play_sampled(const std::vector<Contest>& contests, const Sampling& sampling,
                                     const Progress& progress) {
  for (const auto& contest : contests) check_length(contest, sampling);
  Tallies tallies(contests.size(), sampling);
  play_side_by_side(contests, sampling, tallies, progress);
  std::vector<PairResult> results;
  for (std::size_t c = 0; c < contests.size(); ++c)
    results.push_back(tallies.result(c, method_of(contests[c], sampling.criterion)));
  return results;
}

}  // namespace folk
