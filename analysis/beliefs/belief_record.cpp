#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/play/group_play.h>
#include <folk/games/error.h>
#include <folk/games/match_key.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>

namespace folk {
namespace {

/// A match that is being recorded.
class Table {
public:
  Table(const Strategy& policy, const Strategy& opponent, std::size_t opponent_number)
      : machine_(opponent.machine.get()),
        opponent_number_(opponent_number),
        players_{policy.new_player(), opponent.new_player()} {}

  std::size_t opponent_number() const { return opponent_number_; }
  Player& player(Seat seat) const { return *players_[index(seat)]; }

  void start(const Sampling& sampling, std::uint64_t repetition) {
    for (const Seat seat : both_seats)
      player(seat).start({sampling.payoffs, sampling.criterion,
                          match_key(sampling.seed, opponent_number_, repetition, role_of(seat))});
    if (machine_ != nullptr) state_ = machine_->start();
    match_.clear();
    match_.reserve(sampling.criterion.rounds());
  }

  void play_round() {
    BeliefRound round;
    round.own = player(Seat::first).move();
    round.theirs = player(Seat::second).move();
    round.belief = player(Seat::first).belief();
    player(Seat::first).observe(round.own, round.theirs);
    player(Seat::second).observe(round.theirs, round.own);
    if (machine_ != nullptr) {
      round.truth = machine_->cooperation(state_);
      state_ = machine_->next(state_, round.theirs, round.own);
    } else {
      round.truth = round.theirs == Move::C ? 1 : 0;
    }
    match_.push_back(round);
  }

  BeliefMatch take_match() { return std::exchange(match_, {}); }

private:
  const Machine* machine_;
  std::size_t opponent_number_;
  std::array<std::unique_ptr<Player>, 2> players_;
  State state_ = 0;
  BeliefMatch match_;
};

bool many_can_sit(const Strategy& strategy) { return strategy.machine || strategy.thinks_together; }

/// Players that are to be asked together: those of the policy, and those of opponents that are the same strategy.
class Company {
public:
  Company(const Strategy& policy, const std::vector<Strategy>& opponents)
      : policy_thinks_(!policy.machine && policy.thinks_together),
        opponents_(opponents) {}

  void think(std::span<const std::unique_ptr<Table>> tables, unsigned threads) const {
    std::vector<Player*> policies;
    for (const auto& table : tables) policies.push_back(&table->player(Seat::first));
    if (policy_thinks_) policies.front()->think_together(policies, threads);
    for (std::size_t first = 0; first < tables.size();) {
      const std::size_t opponent = tables[first]->opponent_number();
      std::vector<Player*> peers;
      for (; first < tables.size() && tables[first]->opponent_number() == opponent; ++first)
        peers.push_back(&tables[first]->player(Seat::second));
      const Strategy& strategy = opponents_[opponent];
      if (!strategy.machine && strategy.thinks_together) peers.front()->think_together(peers, threads);
    }
  }

private:
  bool policy_thinks_;
  const std::vector<Strategy>& opponents_;
};

struct Planned {
  std::size_t opponent;
  std::uint64_t repetition;
};

void check(const Strategy& policy, const Sampling& sampling, std::uint64_t matches) {
  if (!sampling.criterion.is_finite())
    throw UsageError(
        fmt::format("beliefs of {} are recorded over finite:T, not over {}: give finite:100 or another "
                    "number of rounds",
                    policy.name, sampling.criterion.to_string()));
  if (sampling.noise > 0)
    throw UsageError(fmt::format("beliefs of {} are recorded without noise, not with {}: give noise 0", policy.name,
                                 sampling.noise.probability()));
  const std::uint64_t rounds = sampling.criterion.rounds();
  if (rounds > most_recorded_rounds || matches > most_recorded_rounds / rounds)
    throw UsageError(
        fmt::format("{} matches of {} rounds are more than {} rounds to record: give fewer rounds or repetitions",
                    matches, rounds, most_recorded_rounds));
}

}  // namespace

bool is_deterministic(const Strategy& strategy) {
  return strategy.machine ? strategy.machine->deterministic() : strategy.deterministic;
}

std::vector<BeliefRecord> record_beliefs(const Strategy& policy, const std::vector<Strategy>& opponents,
                                         const Sampling& sampling, const Progress& progress) {
  std::vector<BeliefRecord> records;
  std::uint64_t matches = 0;
  for (const auto& opponent : opponents) {
    records.push_back({opponent.name, is_deterministic(policy) && is_deterministic(opponent), {}});
    matches += records.back().once ? 1 : sampling.repetitions.count();
  }
  check(policy, sampling, matches);

  std::vector<Planned> seats;
  for (std::size_t i = 0; i < opponents.size(); ++i)
    for (std::uint64_t r = 0; r < (records[i].once ? 1 : sampling.repetitions.count()); ++r) seats.push_back({i, r});

  const Company company(policy, opponents);
  std::vector<std::unique_ptr<Table>> tables;
  std::size_t next = 0;
  while (next < seats.size()) {
    // A program cannot sit at hundreds of tables: it plays one match after the other.
    const auto alone = [&](const Planned& seat) {
      return !many_can_sit(policy) || !many_can_sit(opponents[seat.opponent]);
    };
    std::size_t size = 1;
    while (!alone(seats[next]) && next + size < seats.size() && size < most_matches_at_once &&
           !alone(seats[next + size]))
      ++size;
    tables.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      const auto [opponent, repetition] = seats[next + i];
      if (!tables[i] || tables[i]->opponent_number() != opponent)
        tables[i] = std::make_unique<Table>(policy, opponents[opponent], opponent);
      tables[i]->start(sampling, repetition);
    }
    for (std::uint64_t t = 0; t < sampling.criterion.rounds(); ++t) {
      company.think(tables, sampling.threads);
      for (const auto& table : tables) table->play_round();
      const double share = static_cast<double>(t + 1) / static_cast<double>(sampling.criterion.rounds());
      progress((static_cast<double>(next) + share * static_cast<double>(size)) / static_cast<double>(seats.size()));
    }
    for (std::size_t i = 0; i < size; ++i) records[seats[next + i].opponent].matches.push_back(tables[i]->take_match());
    next += size;
  }
  return records;
}

}  // namespace folk
