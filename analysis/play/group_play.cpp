#include <folk/analysis/play/deterministic_play.h>
#include <folk/analysis/play/group_play.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>

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
class Tally {
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
    for (Guesses* guesses : {&mean.first_guesses, &mean.second_guesses}) {
      guesses->right /= matches_;
      guesses->all /= matches_;
    }
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

bool thinks(const Strategy& strategy) { return !strategy.machine && strategy.thinks_together; }

bool many_can_sit(const Strategy& strategy) { return strategy.machine || strategy.thinks_together; }

/// True for a contest whose matches gain from being played beside others and can be.
bool gains_from_company(const Contest& contest) {
  return (thinks(*contest.first) || thinks(*contest.second)) && many_can_sit(*contest.first) &&
         many_can_sit(*contest.second);
}

std::uint64_t repetitions(const Contest& contest, const Sampling& sampling) {
  return contest.once ? 1 : sampling.repetitions.count();
}

/// The matches to be played, contest by contest.
class Queue {
public:
  struct Task {
    std::size_t contest = 0;
    std::uint64_t repetition = 0;
  };

  Queue(const std::vector<Contest>& contests, const Sampling& sampling)
      : contests_(contests),
        sampling_(sampling) {}

  /// The next matches that are played side by side; empty when all have been played.
  std::vector<Task> next_batch() {
    std::vector<Task> batch;
    while (next_.contest < contests_.size() && batch.size() < most_matches_at_once) {
      const Contest& contest = contests_[next_.contest];
      const bool company = gains_from_company(contest);
      if (!company && !batch.empty()) break;
      batch.push_back(next_);
      if (++next_.repetition == repetitions(contest, sampling_)) next_ = {next_.contest + 1, 0};
      if (!company) break;
    }
    return batch;
  }

private:
  const std::vector<Contest>& contests_;
  const Sampling& sampling_;
  Task next_;
};

/// The players of each strategy that thinks together, in the matches that go on.
std::vector<std::vector<Player*>> thinking_players(std::span<const std::unique_ptr<PlayedMatch>> matches) {
  std::vector<const Strategy*> strategies;
  std::vector<std::vector<Player*>> groups;
  for (const auto& match : matches) {
    if (match->rounds_left() == 0) continue;
    for (const Seat seat : both_seats) {
      const Strategy* strategy = seat == Seat::first ? match->contest().first : match->contest().second;
      if (!thinks(*strategy)) continue;
      const auto place = std::find(strategies.begin(), strategies.end(), strategy) - strategies.begin();
      if (static_cast<std::size_t>(place) == strategies.size()) {
        strategies.push_back(strategy);
        groups.emplace_back();
      }
      groups[static_cast<std::size_t>(place)].push_back(&match->player(seat));
    }
  }
  return groups;
}

/// Plays to their end the matches that have begun; calls `after_rounds` with the number of rounds just played.
template <class AfterRounds>
void play_out(std::span<const std::unique_ptr<PlayedMatch>> matches, unsigned threads, AfterRounds&& after_rounds) {
  if (thinking_players(matches).empty()) {
    for (const auto& match : matches) {
      const std::uint64_t rounds = match->rounds_left();
      while (match->rounds_left() > 0) match->play_round();
      after_rounds(rounds);
    }
    return;
  }
  for (bool go_on = true; go_on;) {
    for (const auto& peers : thinking_players(matches)) peers.front()->think_together(peers, threads);
    std::uint64_t rounds = 0;
    go_on = false;
    for (const auto& match : matches) {
      if (match->rounds_left() == 0) continue;
      match->play_round();
      ++rounds;
      go_on = go_on || match->rounds_left() > 0;
    }
    after_rounds(rounds);
  }
}

Method method_of(const Contest& contest, const Criterion& criterion) {
  if (!contest.once) return Method::sampled;
  return criterion.kind() == Criterion::Kind::mean ? Method::bounded : Method::played;
}

}  // namespace

std::vector<PairResult> play_group(const std::vector<Contest>& contests, const Sampling& sampling,
                                   const Progress& progress) {
  double matches_in_all = 0;
  for (const auto& contest : contests) {
    check_length(contest, sampling);
    matches_in_all += static_cast<double>(repetitions(contest, sampling));
  }
  const auto payoffs = sampling.payoffs.numbers();

  std::vector<Tally> tallies(contests.size());
  std::vector<std::unique_ptr<PlayedMatch>> tables;
  double matches_done = 0;
  Queue queue(contests, sampling);
  for (auto batch = queue.next_batch(); !batch.empty(); batch = queue.next_batch()) {
    tables.resize(batch.size());
    double rounds = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Contest& contest = contests[batch[i].contest];
      // Who meets the same opponent again stays seated: a program need not be started anew.
      if (!tables[i] || tables[i]->contest() != contest) tables[i] = std::make_unique<PlayedMatch>(contest, sampling);
      tables[i]->start(batch[i].repetition);
      rounds += static_cast<double>(tables[i]->rounds_left());
    }
    double rounds_done = 0;
    play_out(tables, sampling.threads, [&](std::uint64_t more) {
      rounds_done += static_cast<double>(more);
      const double share = rounds_done / rounds * static_cast<double>(batch.size());
      progress((matches_done + share) / matches_in_all);
    });
    for (std::size_t i = 0; i < batch.size(); ++i) tallies[batch[i].contest].add(*tables[i], payoffs);
    matches_done += static_cast<double>(batch.size());
  }

  std::vector<PairResult> results;
  for (std::size_t c = 0; c < contests.size(); ++c)
    results.push_back(tallies[c].result(method_of(contests[c], sampling.criterion)));
  return results;
}

}  // namespace folk
