#include <folk/games/outcome.h>
#include <folk/tools/ipd_match/record.h>

#include <folk/tools/choices/standard_names.h>

#include <folk/analysis/play/side_by_side.h>
#include <folk/games/criterion.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

/// Writes a match into a record.
struct Recorder {
  struct Sheet {
    MatchRecord* record;

    void round(const SeatedMatch& match, const PlayedRound& round) {
      record->transcript.append(round.own, round.theirs);
      for (const Seat seat : both_seats) {
        record->slipped[index(seat)].push_back(round.slipped[index(seat)]);
        record->beliefs[index(seat)].push_back(
            match.player(seat).belief().value_or(std::numeric_limits<double>::quiet_NaN()));
      }
    }
  };

  MatchRecord record;

  Sheet begin(const SeatedMatch&) { return {&record}; }
  void end(const SeatedMatch&, Sheet) {
    for (auto& beliefs : record.beliefs) drop_empty_beliefs(beliefs);
  }
};

}  // namespace

MatchRecord play_one(const MatchSettings& settings, const Progress& progress) {
  const Registry registry = standard_names(settings.policies);
  Recorder recorder;
  MatchRecord& record = recorder.record;
  std::array<Strategy, 2> strategies;
  for (const Seat seat : both_seats) {
    Strategy& strategy = strategies[index(seat)];
    strategy = registry.make(settings.players[index(seat)], settings.game.payoffs);
    record.names[index(seat)] = strategy.name;
    if (!strategy.caveat.empty() && std::count(record.caveats.begin(), record.caveats.end(), strategy.caveat) == 0)
      record.caveats.push_back(strategy.caveat);
  }
  const MatchRules rules{settings.game.payoffs, Criterion::finite(settings.rounds), settings.noise};
  play_side_by_side({Contest{&strategies[0], &strategies[1]}}, {rules, 1, settings.seed}, recorder, progress);
  return std::move(recorder.record);
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
