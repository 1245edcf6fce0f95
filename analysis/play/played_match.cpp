#include <folk/analysis/play/deterministic_play.h>
#include <folk/analysis/play/played_match.h>
#include <folk/games/error.h>
#include <folk/games/match.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <cmath>

namespace folk {
namespace {

/// Of a match without end, which is followed until the rest does not count.
std::uint64_t rounds_that_weigh(const Criterion& criterion) {
  return static_cast<std::uint64_t>(criterion.rounds_until_left(1e-12));
}

/// For ending:p drawn from the geometric distribution, unless one match is to stand for all lengths.
std::uint64_t length_of_match(const Criterion& criterion, bool once, const RandomKey& key) {
  switch (criterion.kind()) {
    case Criterion::Kind::finite: return criterion.rounds();
    case Criterion::Kind::mean: return long_run_rounds;
    case Criterion::Kind::discounted: return rounds_that_weigh(criterion);
    case Criterion::Kind::ending: break;
  }
  if (criterion.continuation() == 0) return 1;
  if (once) return rounds_that_weigh(criterion);
  const double u = RandomStream(key).uniform();
  return 1 + static_cast<std::uint64_t>(std::log1p(-u) / std::log(criterion.continuation()));
}

/// Rounds that the matches of a contest take, about.
double expected_rounds(const Contest& contest, const Sampling& sampling) {
  if (contest.once) return static_cast<double>(length_of_match(sampling.criterion, true, {}));
  const double a_match = sampling.criterion.kind() == Criterion::Kind::ending
                             ? sampling.criterion.total_weight()
                             : static_cast<double>(length_of_match(sampling.criterion, false, {}));
  return a_match * static_cast<double>(sampling.repetitions);
}

}  // namespace

void check_length(const Contest& contest, const Sampling& sampling) {
  if (expected_rounds(contest, sampling) <= static_cast<double>(most_steps)) return;
  if (contest.once)
    throw UsageError(
        fmt::format("a match under {} is more than {} rounds", sampling.criterion.to_string(), most_steps));
  throw UsageError(fmt::format("{} repetitions under {} are more than {} rounds: give fewer",
                               sampling.repetitions.count(), sampling.criterion.to_string(), most_steps));
}

PlayedMatch::PlayedMatch(const Contest& contest, const Sampling& sampling)
    : contest_(contest),
      sampling_(sampling),
      players_{contest.first->new_player(), contest.second->new_player()},
      may_believe_{!contest.first->machine, !contest.second->machine} {
  switch (sampling.criterion.kind()) {
    case Criterion::Kind::finite: break;
    case Criterion::Kind::mean: scale_ = 1.0 / static_cast<double>(long_run_rounds); break;
    case Criterion::Kind::discounted:
      continuation_ = sampling.criterion.continuation();
      scale_ = 1 - continuation_;
      break;
    case Criterion::Kind::ending:
      // A drawn length weighs by itself.
      if (contest.once) continuation_ = sampling.criterion.continuation();
  }
}

void PlayedMatch::start(std::uint64_t repetition) {
  const auto key = [&](MatchRole role) { return match_key(sampling_.seed, contest_.pair, repetition, role); };
  for (const Seat seat : both_seats) player(seat).start({sampling_.payoffs, sampling_.criterion, key(role_of(seat))});
  noise_.emplace(key(MatchRole::noise));
  rounds_left_ = length_of_match(sampling_.criterion, contest_.once, key(MatchRole::length));
  weight_ = 1;
  weights_ = {};
  guesses_ = {};
}

void PlayedMatch::play_round() {
  play_match(
      player(Seat::first), player(Seat::second), 1,
      [&] { return sampling_.noise > 0 && noise_->chance(sampling_.noise); },
      [&](Move a, Move b) {
        judge_belief(Seat::first, b);
        judge_belief(Seat::second, a);
        weights_[Outcome{a, b}.index()] += weight_;
      });
  weight_ *= continuation_;
  --rounds_left_;
}

OutcomeWeights PlayedMatch::weights() const {
  OutcomeWeights scaled = weights_;
  for (double& weight : scaled) weight *= scale_;
  return scaled;
}

Guesses PlayedMatch::guesses(Seat seat) const {
  return {guesses_[index(seat)].right * scale_, guesses_[index(seat)].all * scale_};
}

void PlayedMatch::judge_belief(Seat seat, Move theirs) {
  if (!may_believe_[index(seat)]) return;
  const auto belief = player(seat).belief();
  if (!belief) return;
  guesses_[index(seat)] += {likelier_move(*belief) == theirs ? weight_ : 0, weight_};
}

}  // namespace folk
