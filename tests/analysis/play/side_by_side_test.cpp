// Matches side by side: what is drawn and handed on, what is told to those that think together, and that it changes
// nothing.

#include <analysis/play/mirror.h>
#include <folk/analysis/play/sampled_play.h>
#include <folk/analysis/play/side_by_side.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/match_key.h>
#include <folk/strategies/registry.h>
#include <games/ended_work.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace folk {
namespace {

using test::Diary;
using test::mirror;
using test::opaque;
using test::with_classics;

/// Writes down all that the engine hands it.
struct Protocol {
  struct Match {
    std::size_t contest = 0;
    std::uint64_t repetition = 0;
    std::uint64_t length = 0;
    std::string moves;  ///< first, second, first, second, ...
    std::string slips;  ///< in the same order
    std::string beliefs;

    bool operator==(const Match&) const = default;
  };

  struct Sheet {
    Match match;

    void round(const SeatedMatch& seated, const PlayedRound& round) {
      for (const Move move : {round.own, round.theirs}) match.moves += to_char(move);
      for (const bool slip : round.slipped) match.slips += slip ? 'x' : '.';
      for (const Seat seat : both_seats)
        if (const auto belief = seated.player(seat).belief()) match.beliefs += to_char(likelier_move(*belief));
    }
  };

  std::vector<Match> begun{};
  std::vector<Match> ended{};

  Sheet begin(const SeatedMatch& match) {
    begun.push_back({match.contest_number(), match.repetition(), match.rounds(), {}, {}, {}});
    return {begun.back()};
  }
  void end(const SeatedMatch& match, Sheet sheet) {
    EXPECT_EQ(match.contest_number(), sheet.match.contest);
    EXPECT_EQ(match.repetition(), sheet.match.repetition);
    ended.push_back(sheet.match);
  }
};

/// A match played by hand: the players, then whose move slips, each with a stream of its own.
Protocol::Match by_hand(const Contest& contest, std::uint64_t repetition, const Sampling& sampling, bool both_slip) {
  Protocol::Match match{0, repetition, sampling.criterion.rounds(), {}, {}, {}};
  const auto key = [&](MatchRole role) { return match_key(sampling.seed, contest.pair, repetition, role); };
  const std::array players{contest.first->new_player(), contest.second->new_player()};
  for (const Seat seat : both_seats)
    players[index(seat)]->start({sampling.payoffs, sampling.criterion, key(role_of(seat))});
  RandomStream noise(key(MatchRole::noise));
  for (std::uint64_t t = 0; t < match.length; ++t) {
    std::array moves{players[0]->move(), players[1]->move()};
    for (const Seat seat : both_seats) {
      const bool slip = (seat == Seat::first || both_slip) && noise.chance(sampling.noise);
      Move& move = moves[index(seat)];
      if (slip) move = other(move);
      match.moves += to_char(move);
      match.slips += slip ? 'x' : '.';
    }
    players[0]->observe(moves[0], moves[1]);
    players[1]->observe(moves[1], moves[0]);
  }
  return match;
}

TEST(SideBySide, DrawsWhatTheKeysSayInTheOrderOfTheSeats) {
  const auto roster = Registry::standard().roster("random(0.3),gtft(0.4)");
  const std::vector<Contest> contests{{&roster[0], &roster[1], 7}, {&roster[1], &roster[1], 9}};
  const Sampling sampling{{{}, Criterion::finite(50), 0.2}, 3, 5};
  for (const bool both : {true, false}) {
    Protocol protocol;
    play_side_by_side(contests, sampling, protocol, nullptr, both ? Slipping::both : Slipping::first);
    ASSERT_EQ(protocol.ended.size(), 6U);
    for (std::size_t m = 0; m < 6; ++m) {
      auto expected = by_hand(contests[m / 3], m % 3, sampling, both);
      expected.contest = m / 3;
      EXPECT_EQ(protocol.ended[m], expected) << m << " " << protocol.ended[m].moves << " " << expected.moves;
    }
    EXPECT_NE(protocol.ended[0].moves, protocol.ended[1].moves);
  }
}

TEST(SideBySide, HandsOnEveryMatchInItsOrderHoweverTheyAreSeated) {
  const auto diary = std::make_shared<Diary>();
  const Strategy toy = mirror(diary, false, true);
  const Strategy slow = mirror(std::make_shared<Diary>(), false, false);
  const auto machines = Registry::standard().roster("random(0.5),all_d");
  // Side by side, alone, and side by side again; lengths differ.
  const std::vector<Contest> contests{{&toy, &machines[0], 0},  {&machines[1], &toy, 1, true},   {&slow, &toy, 2},
                                      {&machines[0], &slow, 3}, {&machines[0], &machines[0], 4}, {&toy, &toy, 5}};
  const Sampling sampling{{{}, Criterion::ending(0.1), 0.0}, 140, 3};
  Protocol protocol;
  play_side_by_side(contests, sampling, protocol);
  EXPECT_EQ(diary->largest_group, 280U) << "both seats of self-play";
  std::vector<Protocol::Match> expected;
  for (std::size_t c = 0; c < contests.size(); ++c) {
    ASSERT_EQ(matches_of(contests[c], sampling), c == 1 ? 1U : 140U);
    for (std::uint64_t r = 0; r < matches_of(contests[c], sampling); ++r) expected.push_back({c, r, 0, {}, {}, {}});
  }
  ASSERT_EQ(protocol.ended.size(), expected.size());
  for (std::size_t m = 0; m < expected.size(); ++m) {
    const auto& match = protocol.ended[m];
    EXPECT_EQ(match.contest, expected[m].contest) << m;
    EXPECT_EQ(match.repetition, expected[m].repetition) << m;
    EXPECT_EQ(protocol.begun[m].contest, match.contest);
    EXPECT_EQ(protocol.begun[m].repetition, match.repetition);
    EXPECT_EQ(match.moves.size(), 2 * match.length) << m;
    EXPECT_EQ(match.slips, std::string(2 * match.length, '.'));
  }
}

TEST(SideBySide, ASheetSeesTheBeliefsThatTheMovesWereMadeBy) {
  const Strategy toy = mirror(std::make_shared<Diary>(), true, true);
  const auto other = Registry::standard().make("per_cd");
  Protocol protocol;
  play_side_by_side({Contest{&toy, &other, 0, true}}, {{{}, Criterion::finite(4)}}, protocol);
  EXPECT_EQ(protocol.ended.at(0).moves, "CCCDDCCD");
  EXPECT_EQ(protocol.ended.at(0).beliefs, "CCDC") << "told of a round before the players are";
}

TEST(SideBySide, TellsOfMachinesNowAndThenAndOfOthersEachRound) {
  const auto machines = Registry::standard().roster("all_c,all_d");
  const Strategy slow = mirror(std::make_shared<Diary>(), true, false);
  const Sampling sampling{{{}, Criterion::finite(10'000)}, 2};
  const auto shares = [&](const Strategy& first) {
    std::vector<double> told;
    Protocol protocol;
    play_side_by_side({Contest{&first, &machines[1]}}, sampling, protocol,
                      [&](double share) { told.push_back(share); });
    return told;
  };
  EXPECT_EQ(shares(machines[0]), (std::vector<double>{0.2048, 0.4096, 0.5, 0.7048, 0.9096, 1}));
  EXPECT_EQ(shares(slow).size(), 20'000U);
}

TEST(SideBySideThreads, EndsAsItsProgressWishes) {
  const auto machines = Registry::standard().roster("random(0.5),all_d");
  for (const bool together : {false, true}) {
    const Strategy toy = mirror(std::make_shared<Diary>(), false, together);
    const std::vector<Contest> contests{{&toy, &machines[0], 0}, {&machines[0], &machines[1], 1}, {&toy, &toy, 2}};
    test::expect_ends([&](const Progress& progress) {
      Protocol protocol;
      play_side_by_side(contests, {{{}, Criterion::finite(5)}, 3}, protocol, progress);
      EXPECT_EQ(protocol.ended.size(), 9U);
    });
  }
}

TEST(SideBySide, AsksAllPlayersOfAStrategyOnceARound) {
  const auto diary = std::make_shared<Diary>();
  const Strategy toy = mirror(diary, true, true);
  const auto others = Registry::standard().roster("all_d,pavlov");
  Sampling sampling;
  sampling.criterion = Criterion::finite(7);
  sampling.threads = 3;
  const auto results =
      play_sampled({{&toy, &others[0], 0, true}, {&others[1], &toy, 1, true}, {&toy, &toy, 2, true}}, sampling);
  EXPECT_EQ(diary->thoughts, 7U);
  EXPECT_EQ(diary->largest_group, 4U) << "both seats of self-play";
  EXPECT_EQ(diary->threads, 3U);
  EXPECT_EQ(diary->alive, 0U);
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0].weights, (OutcomeWeights{0, 1, 0, 6}));
  EXPECT_EQ(results[0].method, Method::played);
  EXPECT_EQ(results[0].first_error, 0);
  // C was expected of all_d in the first round alone.
  EXPECT_EQ(results[0].first_guesses.right, 6);
  EXPECT_EQ(results[0].first_guesses.all, 7);
  EXPECT_EQ(results[0].second_guesses.all, 0);
  EXPECT_EQ(results[1].second_guesses.right, 7);
  EXPECT_EQ(exchanged(results[1]).first_guesses.all, 7);
  EXPECT_FALSE(results[1].first_guesses.accuracy());
}

TEST(SideBySide, GivesTheSameWithOrWithoutCompany) {
  for (const auto& criterion : {Criterion::finite(40), Criterion::ending(0.1), Criterion::discounted(0.8)}) {
    TournamentSettings settings;
    settings.criterion = criterion;
    settings.noise = 0.05;
    settings.repetitions = 30;
    const auto diary = std::make_shared<Diary>();
    const auto together = play_tournament(with_classics(mirror(diary, true, true)), settings);
    EXPECT_EQ(diary->largest_group, most_matches_at_once);
    const auto alone = std::make_shared<Diary>();
    const auto apart = play_tournament(with_classics(mirror(alone, true, false)), settings);
    EXPECT_EQ(alone->thoughts, 0U);
    EXPECT_LE(alone->most_alive, 2U) << "one match at a time";
    EXPECT_EQ(together.signature(), apart.signature());
    EXPECT_EQ(together.method(0, 18), Method::sampled);
    EXPECT_GT(together.standard_error(0, 18), 0);
  }
}

TEST(SideBySide, DoesNotSeatManyOfAProgram) {
  const auto started = std::make_shared<std::size_t>(0);
  const auto machine = Registry::standard().make("random(0.4)").machine;
  const Strategy program{"program", nullptr, [=] {
                           ++*started;
                           return play(machine);
                         }};
  const auto diary = std::make_shared<Diary>();
  const Strategy toy = mirror(diary, true, true);
  Sampling sampling;
  sampling.criterion = Criterion::finite(5);
  play_sampled({{&toy, &program, 0}}, sampling);
  EXPECT_EQ(*started, 1U) << "it stays for all repetitions";
  EXPECT_EQ(diary->most_alive, 1U);
  EXPECT_EQ(diary->thoughts, 500U);
}

TEST(SideBySide, TellsItsProgress) {
  const auto diary = std::make_shared<Diary>();
  const Strategy toy = mirror(diary, false, true);
  Sampling sampling;
  sampling.repetitions = 300;
  sampling.criterion = Criterion::ending(0.2);
  double last = 0;
  play_sampled({{&toy, &toy, 0}}, sampling, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_NEAR(last, 1, 1e-12);
  EXPECT_TRUE(play_sampled({}, sampling).empty());
}

TEST(SideBySideThreads, DoNotChangeTheResults) {
  TournamentSettings settings;
  settings.criterion = Criterion::finite(20);
  settings.repetitions = 20;
  const auto entrants = with_classics(mirror(std::make_shared<Diary>(), true, true));
  const auto one = play_tournament(entrants, settings);
  settings.threads = 4;
  double last = 0;
  const auto four = play_tournament(entrants, settings, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_NEAR(last, 1, 1e-12);
  EXPECT_EQ(one.signature(), four.signature());
}

}  // namespace
}  // namespace folk
