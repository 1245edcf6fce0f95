#include <folk/games/outcome.h>
#include <folk/tools/ipd_match/record.h>

#include <folk/tools/choices/standard_names.h>

#include <folk/games/criterion.h>
#include <folk/games/match.h>
#include <folk/games/match_key.h>
#include <folk/strategies/player.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace folk::tools {
namespace {

/// Forgets the beliefs of a player that told none in any round.
void drop_empty_beliefs(std::vector<double>& beliefs) {
  if (std::all_of(beliefs.begin(), beliefs.end(), [](double belief) { return std::isnan(belief); })) beliefs.clear();
}

/// The payoff of one seat in one round.
Rational payoff(const std::array<Rational, 4>& by_outcome, const MatchRecord& record, Seat seat, std::size_t round) {
  const Outcome outcome = record.transcript.outcome(round);
  return by_outcome[(seat == Seat::first ? outcome : outcome.exchanged()).index()];
}

}  // namespace

MatchRecord play_one(const MatchSettings& settings, const Progress& progress) {
  const Registry registry = standard_names(settings.policies);
  MatchRecord record;
  std::array<std::unique_ptr<Player>, 2> players;
  for (const Seat seat : both_seats) {
    const Strategy strategy = registry.make(settings.players[index(seat)], settings.game.payoffs);
    record.names[index(seat)] = strategy.name;
    if (!strategy.caveat.empty() && std::count(record.caveats.begin(), record.caveats.end(), strategy.caveat) == 0)
      record.caveats.push_back(strategy.caveat);
    players[index(seat)] = strategy.new_player();
    players[index(seat)]->start(
        {settings.game.payoffs, Criterion::finite(settings.rounds), match_key(settings.seed, 0, 0, role_of(seat))});
  }
  RandomStream noise(match_key(settings.seed, 0, 0, MatchRole::noise));
  std::size_t asked = 0;
  const auto slips = [&] {
    const bool slip = noise.chance(settings.noise);
    record.slipped[asked++ % 2].push_back(slip);
    return slip;
  };
  play_match(*players[0], *players[1], settings.rounds, slips, [&](Move first, Move second) {
    record.transcript.append(first, second);
    for (std::size_t seat = 0; seat < 2; ++seat)
      record.beliefs[seat].push_back(players[seat]->belief().value_or(std::numeric_limits<double>::quiet_NaN()));
    progress(static_cast<double>(record.transcript.rounds()) / static_cast<double>(settings.rounds));
  });
  for (auto& beliefs : record.beliefs) drop_empty_beliefs(beliefs);
  return record;
}

std::vector<Rational> running_scores(const MatchSettings& settings, const MatchRecord& record, Seat seat) {
  const auto by_outcome = settings.game.payoffs.by_outcome();
  std::vector<Rational> scores;
  scores.reserve(record.transcript.rounds());
  Rational sum = 0;
  for (std::size_t t = 0; t < record.transcript.rounds(); ++t) {
    sum += payoff(by_outcome, record, seat, t);
    scores.push_back(sum);
  }
  return scores;
}

double cooperation_rate(const MatchRecord& record, Seat seat) {
  const auto& counts = record.transcript.counts();
  const std::uint64_t cooperations = counts[0] + (seat == Seat::first ? counts[1] : counts[2]);
  return static_cast<double>(cooperations) / static_cast<double>(record.transcript.rounds());
}

std::optional<Move> expected_move(const MatchRecord& record, Seat seat, std::size_t round) {
  const auto& beliefs = record.beliefs[index(seat)];
  if (beliefs.empty() || std::isnan(beliefs[round])) return std::nullopt;
  return likelier_move(beliefs[round]);
}

std::optional<double> belief_accuracy(const MatchRecord& record, Seat seat) {
  if (record.beliefs[index(seat)].empty()) return std::nullopt;
  double right = 0;
  double told = 0;
  for (std::size_t t = 0; t < record.transcript.rounds(); ++t)
    if (const auto expected = expected_move(record, seat, t)) {
      right += *expected == record.move(other(seat), t) ? 1 : 0;
      ++told;
    }
  return right / told;
}

}  // namespace folk::tools
