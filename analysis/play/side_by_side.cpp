#include <folk/analysis/play/deterministic_play.h>
#include <folk/analysis/play/side_by_side.h>
#include <folk/games/error.h>
#include <folk/games/match_key.h>

#include <fmt/format.h>

#include <cmath>

namespace folk {
namespace {

constexpr std::uint64_t turn_of_machines = 4096;

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

bool thinks(const Strategy& strategy) { return !strategy.machine && strategy.thinks_together; }

bool many_can_sit(const Strategy& strategy) { return strategy.machine || strategy.thinks_together; }

/// True for a contest whose matches gain from being played beside others and can be.
bool gains_from_company(const Contest& contest) {
  return (thinks(*contest.first) || thinks(*contest.second)) && many_can_sit(*contest.first) &&
         many_can_sit(*contest.second);
}

}  // namespace

std::uint64_t matches_of(const Contest& contest, const Sampling& sampling) {
  return contest.once ? 1 : sampling.repetitions.count();
}

void check_length(const Contest& contest, const Sampling& sampling) {
  if (expected_rounds(contest, sampling) <= static_cast<double>(most_steps)) return;
  if (contest.once)
    throw UsageError(
        fmt::format("a match under {} is more than {} rounds", sampling.criterion.to_string(), most_steps));
  throw UsageError(fmt::format("{} repetitions under {} are more than {} rounds: give fewer",
                               sampling.repetitions.count(), sampling.criterion.to_string(), most_steps));
}

void SeatedMatch::start(const Contest& contest, std::size_t contest_number, std::uint64_t repetition,
                        const Sampling& sampling, Slipping slipping) {
  if (contest_ != contest || !players_[0]) {
    leave();
    players_ = {contest.first->new_player(), contest.second->new_player()};
  }
  contest_ = contest;
  contest_number_ = contest_number;
  repetition_ = repetition;
  const auto key = [&](MatchRole role) { return match_key(sampling.seed, contest.pair, repetition, role); };
  for (const Seat seat : both_seats) player(seat).start({sampling.payoffs, sampling.criterion, key(role_of(seat))});
  const double noise = sampling.noise;
  noise_ = {noise, slipping == Slipping::both ? noise : 0};
  slips_ = RandomStream(key(MatchRole::noise));
  rounds_ = rounds_left_ = length_of_match(sampling.criterion, contest.once, key(MatchRole::length));
}

void SeatedMatch::leave() {
  for (auto& player : players_)
    if (const auto leaving = std::exchange(player, nullptr)) leaving->finish();
}

MatchTables::MatchTables(const std::vector<Contest>& contests, const Sampling& sampling, Slipping slipping)
    : contests_(contests),
      sampling_(sampling),
      slipping_(slipping) {
  for (const auto& contest : contests) matches_in_all_ += static_cast<double>(matches_of(contest, sampling));
}

std::span<SeatedMatch> MatchTables::seat_next() {
  matches_ended_ += static_cast<double>(seated_.size());
  somebody_thinks_ = false;
  rounds_of_turn_ = turn_of_machines;
  std::size_t size = 0;
  while (next_contest_ < contests_.size() && size < most_matches_at_once) {
    const Contest& contest = contests_[next_contest_];
    const bool company = gains_from_company(contest);
    if (!company && size > 0) break;
    if (size == seated_.size()) seated_.emplace_back();
    seated_[size++].start(contest, next_contest_, next_repetition_, sampling_, slipping_);
    if (++next_repetition_ == matches_of(contest, sampling_)) {
      ++next_contest_;
      next_repetition_ = 0;
    }
    somebody_thinks_ = somebody_thinks_ || thinks(*contest.first) || thinks(*contest.second);
    if (!contest.first->machine || !contest.second->machine) rounds_of_turn_ = 1;
    if (!company) break;
  }
  for (std::size_t i = size; i < seated_.size(); ++i) seated_[i].leave();
  seated_.resize(size);
  return seated_;
}

bool MatchTables::next_turn() {
  if (std::all_of(seated_.begin(), seated_.end(), [](const SeatedMatch& match) { return match.rounds_left() == 0; }))
    return false;
  if (somebody_thinks_)
    for (const auto& peers : thinking_players()) peers.front()->think_together(peers, sampling_.threads);
  return true;
}

double MatchTables::finished_share() const {
  double rounds = 0;
  double rounds_left = 0;
  for (const auto& match : seated_) {
    rounds += static_cast<double>(match.rounds());
    rounds_left += static_cast<double>(match.rounds_left());
  }
  const double share = (rounds - rounds_left) / rounds * static_cast<double>(seated_.size());
  return (matches_ended_ + share) / matches_in_all_;
}

/// The players of each strategy that thinks together, in the matches that go on.
std::vector<std::vector<Player*>> MatchTables::thinking_players() const {
  std::vector<const Strategy*> strategies;
  std::vector<std::vector<Player*>> groups;
  for (const auto& match : seated_) {
    if (match.rounds_left() == 0) continue;
    for (const Seat seat : both_seats) {
      const Strategy* strategy = &match.contest().strategy(seat);
      if (!thinks(*strategy)) continue;
      const auto place = std::find(strategies.begin(), strategies.end(), strategy) - strategies.begin();
      if (static_cast<std::size_t>(place) == strategies.size()) {
        strategies.push_back(strategy);
        groups.emplace_back();
      }
      groups[static_cast<std::size_t>(place)].push_back(&match.player(seat));
    }
  }
  return groups;
}

}  // namespace folk
