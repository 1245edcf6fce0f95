#pragma once
// Records made on the spot: by strategies that slip, or written out.

#include <folk/analysis/judgement/recorded_play.h>
#include <folk/games/match.h>
#include <folk/games/random.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace folk::test {

inline BeliefRound round_of(Move own, Move theirs) {
  return {{own, theirs}, std::nullopt, theirs == Move::C ? 1.0 : 0.0};
}

/// "CCD" and "CDD": a match of three rounds.
inline RecordedMatch match_of(std::string_view own, std::string_view theirs, const std::string& name = "1") {
  RecordedMatch match{name, {}};
  for (std::size_t t = 0; t < own.size(); ++t)
    match.rounds.push_back(round_of(own[t] == 'C' ? Move::C : Move::D, theirs[t] == 'C' ? Move::C : Move::D));
  return match;
}

/// A match of two strategies of which the first alone slips.
inline RecordedMatch played(const Strategy& first, const Strategy& second, std::uint64_t rounds, double slip,
                            std::uint64_t seed) {
  const auto a = first.new_player();
  const auto b = second.new_player();
  a->start({{}, Criterion::finite(rounds), {seed, 0, 0, 0}});
  b->start({{}, Criterion::finite(rounds), {seed, 0, 0, 1}});
  RandomStream random({seed, 0, 0, 2});
  bool firsts = false;
  RecordedMatch match{"1", {}};
  play_match(
      *a, *b, rounds, [&] { return (firsts = !firsts) && random.chance(slip); },
      [&](Move own, Move theirs) { match.rounds.push_back(round_of(own, theirs)); });
  return match;
}

}  // namespace folk::test
