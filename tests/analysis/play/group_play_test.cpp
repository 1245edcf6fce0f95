// Matches side by side: what is told to those that think together, and that it changes nothing.

#include <folk/analysis/play/group_play.h>
#include <folk/analysis/play/pair_player.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace folk {
namespace {

/// What the toy players of one strategy saw.
struct Diary {
  std::size_t alive = 0;
  std::size_t most_alive = 0;
  std::size_t thoughts = 0;
  std::size_t largest_group = 0;
  unsigned threads = 0;
};

/// Plays tit for tat and expects the other to repeat its move (C at first).
class Mirror final : public Player {
public:
  explicit Mirror(std::shared_ptr<Diary> diary)
      : diary_(std::move(diary)) {
    diary_->most_alive = std::max(diary_->most_alive, ++diary_->alive);
  }
  ~Mirror() override { --diary_->alive; }
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;

  void start(const MatchStart&) override {
    last_ = Move::C;
    round_ = 0;
  }
  Move move() override {
    EXPECT_EQ(thought_of_, together_ ? round_ : thought_of_) << "everybody was told before it moved";
    return last_;
  }
  void observe(Move, Move theirs) override {
    last_ = theirs;
    ++round_;
  }
  std::optional<double> belief() const override { return last_ == Move::C ? 0.5 : 0.1; }

  void think_together(std::span<Player* const> peers, unsigned threads) override {
    EXPECT_TRUE(std::find(peers.begin(), peers.end(), this) != peers.end());
    EXPECT_EQ(std::set<Player*>(peers.begin(), peers.end()).size(), peers.size());
    for (Player* peer : peers) {
      auto& mirror = dynamic_cast<Mirror&>(*peer);
      EXPECT_EQ(mirror.round_, round_) << "all are in the same round";
      mirror.thought_of_ = round_;
      mirror.together_ = true;
    }
    ++diary_->thoughts;
    diary_->largest_group = std::max(diary_->largest_group, peers.size());
    diary_->threads = threads;
  }

private:
  std::shared_ptr<Diary> diary_;
  Move last_ = Move::C;
  std::size_t round_ = 0;
  std::size_t thought_of_ = 0;
  bool together_ = false;
};

Strategy mirror(const std::shared_ptr<Diary>& diary, bool deterministic, bool thinks_together) {
  Strategy strategy{"mirror", nullptr, [diary] { return std::make_unique<Mirror>(diary); }};
  strategy.deterministic = deterministic;
  strategy.thinks_together = thinks_together;
  return strategy;
}

/// The same strategy without a machine to look into.
Strategy opaque(const std::string& name) {
  const auto machine = Registry::standard().make(name).machine;
  return {"opaque " + name, nullptr, [machine] { return play(machine); }};
}

std::vector<Strategy> with_classics(const Strategy& strategy) {
  auto roster = Registry::standard().roster("classics,random(0.3)");
  roster.push_back(strategy);
  return roster;
}

TEST(GroupPlay, AsksAllPlayersOfAStrategyOnceARound) {
  const auto diary = std::make_shared<Diary>();
  const Strategy toy = mirror(diary, true, true);
  const auto others = Registry::standard().roster("all_d,pavlov");
  Sampling sampling;
  sampling.criterion = Criterion::finite(7);
  sampling.threads = 3;
  const auto results =
      play_group({{&toy, &others[0], 0, true}, {&others[1], &toy, 1, true}, {&toy, &toy, 2, true}}, sampling);
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

TEST(GroupPlay, GivesTheSameWithOrWithoutCompany) {
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

TEST(GroupPlay, DoesNotSeatManyOfAProgram) {
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
  play_group({{&toy, &program, 0}}, sampling);
  EXPECT_EQ(*started, 1U) << "it stays for all repetitions";
  EXPECT_EQ(diary->most_alive, 1U);
  EXPECT_EQ(diary->thoughts, 500U);
}

TEST(GroupPlay, TellsItsProgress) {
  const auto diary = std::make_shared<Diary>();
  const Strategy toy = mirror(diary, false, true);
  Sampling sampling;
  sampling.repetitions = 300;
  sampling.criterion = Criterion::ending(0.2);
  double last = 0;
  play_group({{&toy, &toy, 0}}, sampling, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_NEAR(last, 1, 1e-12);
  EXPECT_TRUE(play_group({}, sampling).empty());
}

TEST(GroupPlay, RefusesWhatTakesTooLong) {
  const Strategy toy = mirror(std::make_shared<Diary>(), true, true);
  Sampling sampling;
  sampling.criterion = Criterion::finite(1'000'000'000);
  EXPECT_THROW(play_group({{&toy, &toy, 0, true}}, sampling), UsageError);
  sampling.criterion = Criterion::finite(10'000'000);
  EXPECT_THROW(play_group({{&toy, &toy, 0}}, sampling), UsageError);
  TournamentSettings settings;
  settings.criterion = Criterion::finite(1'000'000'000);
  try {
    const auto tournament = play_tournament({toy}, settings);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("mirror against mirror"), std::string::npos) << error.what();
  }
}

TEST(GroupPlay, OneMatchOfDeterministicPlayersIsAllThereIs) {
  const auto registry = Registry::standard();
  Strategy copy = opaque("gradual");
  copy.deterministic = true;
  for (const auto& criterion : {Criterion::finite(100), Criterion::discounted(0.95), Criterion::ending(0.02),
                                Criterion::discounted(1e-9), Criterion::ending(1)}) {
    for (const bool together : {false, true}) {
      copy.thinks_together = together;
      for (const auto& other : registry.roster("pavlov,per_ccd,all_d,gradual")) {
        Sampling sampling;
        sampling.criterion = criterion;
        const auto played = play_pair(copy, other, sampling);
        const auto exact = play_pair(registry.make("gradual"), other, sampling);
        EXPECT_EQ(played.method, Method::played);
        for (std::size_t o = 0; o < 4; ++o)
          EXPECT_NEAR(played.weights[o], exact.weights[o], criterion.is_finite() ? 0 : 1e-11 * criterion.total_weight())
              << criterion.to_string() << " " << other.name;
      }
    }
  }
  Sampling sampling;
  sampling.criterion = Criterion::mean();
  EXPECT_EQ(play_pair(copy, registry.make("pavlov"), sampling).method, Method::bounded);
  sampling.criterion = Criterion::finite(10);
  EXPECT_EQ(play_pair(copy, registry.make("random(0.5)"), sampling).method, Method::sampled);
  sampling.noise = 0.1;
  EXPECT_EQ(play_pair(copy, registry.make("pavlov"), sampling).method, Method::sampled);
}

TEST(GroupPlay, TheTournamentKnowsWhoBelievesWhatIsTrue) {
  TournamentSettings settings;
  settings.criterion = Criterion::finite(10);
  auto roster = Registry::standard().roster("all_d,per_cd,tit_for_tat");
  roster.push_back(mirror(std::make_shared<Diary>(), true, true));
  roster.back().caveat = "a toy";
  roster.push_back(roster.back());
  roster.back().name = "its twin";
  const auto tournament = play_tournament(roster, 3, settings);
  EXPECT_TRUE(tournament.has_beliefs());
  EXPECT_EQ(tournament.caveats(), std::vector<std::string>{"a toy"});
  EXPECT_FALSE(tournament.belief_accuracy(0, 3));
  EXPECT_DOUBLE_EQ(*tournament.belief_accuracy(3, 0), 0.9);
  EXPECT_DOUBLE_EQ(*tournament.belief_accuracy(3, 1), 0.1);
  EXPECT_DOUBLE_EQ(*tournament.belief_accuracy(3, 3), 1);
  EXPECT_DOUBLE_EQ(*tournament.belief_accuracy(3, 4), 1);
  for (const auto& entry : tournament.ranking()) {
    const bool believes = entry.entrant >= 3;
    EXPECT_EQ(entry.belief_accuracy.has_value(), believes);
    EXPECT_DOUBLE_EQ(entry.belief_accuracy.value_or(0.8), (9 + 1 + 10 + 10 + 10) / 50.0);
    EXPECT_EQ(entry.method, believes ? Method::played : entry.method);
    long double against = 0;
    for (std::size_t j = 0; j < 3; ++j)
      if (j != entry.entrant) against += static_cast<long double>(tournament.score(entry.entrant, j));
    EXPECT_EQ(entry.total_against_roster, against);
  }
  // Two that tie exactly share their rank.
  EXPECT_EQ(tournament.ranking()[0].total == tournament.ranking()[1].total,
            tournament.ranking()[0].rank == tournament.ranking()[1].rank);
  // Beliefs are part of what was computed.
  for (auto& strategy : roster)
    if (!strategy.machine) strategy.make_player = [make = opaque("tit_for_tat").make_player] { return make(); };
  const auto without = play_tournament(roster, 3, settings);
  EXPECT_FALSE(without.has_beliefs());
  EXPECT_EQ(without.score(3, 1), tournament.score(3, 1));
  EXPECT_NE(without.signature(), tournament.signature());
}

TEST(GroupPlay, WithoutSelfPlayNobodyMeetsItself) {
  TournamentSettings settings;
  settings.self_play = false;
  const auto diary = std::make_shared<Diary>();
  const auto tournament = play_tournament(with_classics(mirror(diary, true, true)), settings);
  EXPECT_FALSE(tournament.played(18, 18));
  for (const auto& entry : tournament.ranking())
    EXPECT_NEAR(static_cast<double>(entry.total), static_cast<double>(entry.total_against_roster), 1e-9)
        << "there are no guests";
}

TEST(GroupPlayThreads, DoNotChangeTheResults) {
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
