// The transformer as a player: what it accepts, and that neither company nor history of the object changes its play.

#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/sct/policy/roster_play.h>
#include <folk/sct/policy/sct_player.h>
#include <folk/strategies/registry.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>
#include <sct/policy/playing_policy.h>

#include <algorithm>
#include <utility>

namespace folk::sct {
namespace {

constexpr std::uint64_t trained_rounds = 14;

MatchStart match_of(std::uint64_t rounds = trained_rounds, const RandomKey& key = {}) {
  return {{}, Criterion::finite(rounds), key};
}

/// What a player did in one match: its moves and its beliefs (-1 without).
struct Record {
  std::vector<Move> moves;
  std::vector<double> beliefs;

  bool operator==(const Record&) const = default;
};

/// One match against moves that `script` draws, some own moves turned by noise.
Record play_script(Player& player, const MatchStart& match, std::uint64_t rounds, std::uint64_t script) {
  test::Draw draw(script);
  Record record;
  player.start(match);
  for (std::uint64_t t = 0; t < rounds; ++t) {
    const Move own = player.move();
    record.moves.push_back(own);
    record.beliefs.push_back(player.belief().value_or(-1));
    player.observe(draw.chance(0.1) ? other(own) : own, draw.chance(0.5) ? Move::C : Move::D);
  }
  return record;
}

Record play_script(const Strategy& strategy, const MatchStart& match, std::uint64_t rounds, std::uint64_t script) {
  return play_script(*strategy.new_player(), match, rounds, script);
}

class TransformerTest : public ::testing::TestWithParam<test::Training> {
protected:
  std::shared_ptr<const Mind> mind = test::playing_mind(GetParam(), 2);
  Strategy sct = transformer("sct", mind);
};

TEST_P(TransformerTest, SaysTruthfullyWhatItIs) {
  EXPECT_EQ(sct.name, "sct");
  EXPECT_EQ(sct.machine, nullptr);
  EXPECT_TRUE(sct.deterministic);
  EXPECT_TRUE(sct.thinks_together);
  EXPECT_TRUE(sct.caveat.empty());
}

TEST_P(TransformerTest, PlaysTheSameAgainWhateverItPlayedBefore) {
  const auto used = sct.new_player();
  for (std::uint64_t script = 1; script <= 4; ++script) {
    const auto record = play_script(*used, match_of(), trained_rounds, script);
    EXPECT_EQ(record, play_script(sct, match_of(), trained_rounds, script));
    EXPECT_EQ(record, play_script(sct, match_of(trained_rounds, {9, 8, 7, 1}), trained_rounds, script));
  }
}

TEST_P(TransformerTest, BelievesInProbabilitiesIfItWasTrainedTo) {
  const bool believes = GetParam().mode != LossMode::action_only;
  std::vector<double> beliefs;
  for (std::uint64_t script = 1; script <= 4; ++script)
    for (const double belief : play_script(sct, match_of(), trained_rounds, script).beliefs) beliefs.push_back(belief);
  const auto [least, most] = std::minmax_element(beliefs.begin(), beliefs.end());
  if (believes) {
    EXPECT_GE(*least, 0);
    EXPECT_LE(*most, 1);
    EXPECT_LT(*least, *most);
  } else {
    EXPECT_EQ(*most, -1);
  }
}

TEST_P(TransformerTest, MovesAndBeliefsAreTheThinkers) {
  const auto player = sct.new_player();
  player->start(match_of());
  auto so_far = begin_match(4.2);
  test::Draw draw(5);
  for (std::uint64_t t = 0; t < trained_rounds; ++t) {
    const auto thought = Thinker(*mind).think(so_far);
    const Move own = player->move();
    if (std::abs(thought.cooperation - 0.5) > 1e-4) {
      EXPECT_EQ(own, likelier_move(thought.cooperation));
    }
    if (player->belief()) {
      EXPECT_NEAR(*player->belief(), thought.belief, 1e-5);
    }
    const Move played = draw.chance(0.2) ? other(own) : own;
    const Move theirs = draw.chance(0.5) ? Move::C : Move::D;
    player->observe(played, theirs);
    constexpr std::array rewards{3.0, 0.0, 5.0, 1.0};
    add_round(so_far, played, theirs, likelier_move(thought.belief), rewards[Outcome{played, theirs}.index()] / 10);
  }
}

/// Before and after a move, in rounds whose window still grows and in those whose window slides.
TEST_P(TransformerTest, AClonePlaysOnAsTheOriginal) {
  for (std::uint64_t parting = 0; parting < trained_rounds; ++parting)
    for (const bool moved : {false, true}) {
      test::Draw draw(parting + 1);
      const auto original = sct.new_player();
      original->start(match_of());
      std::unique_ptr<Player> copy;
      for (std::uint64_t t = 0; t < trained_rounds; ++t) {
        if (t == parting && !moved) copy = original->clone();
        const Move own = original->move();
        if (t == parting && moved) copy = original->clone();
        if (copy) {
          EXPECT_EQ(copy->move(), own);
          EXPECT_EQ(copy->belief(), original->belief()) << "round " << t << ", cloned in round " << parting;
        }
        const Move played = draw.chance(0.1) ? other(own) : own;
        const Move theirs = draw.chance(0.5) ? Move::C : Move::D;
        original->observe(played, theirs);
        if (copy) copy->observe(played, theirs);
      }
    }
}

/// Twelve matches of which some begin alike and part later: companions that know each other's thoughts must go on
/// rightly when they are alone again.
TEST_P(TransformerTest, ThinksTogetherAsAloneOnAnyThreads) {
  constexpr std::size_t matches = 12;
  std::vector<std::unique_ptr<Player>> together;
  std::vector<std::unique_ptr<Player>> alone;
  for (std::size_t i = 0; i < matches; ++i) {
    together.push_back(sct.new_player());
    alone.push_back(sct.new_player());
    together.back()->start(match_of());
    alone.back()->start(match_of());
  }
  test::Draw draw(6);
  for (std::uint64_t t = 0; t < trained_rounds; ++t) {
    std::vector<Player*> peers;
    for (const auto& player : together)
      if (t % 4 != 3 || draw.chance(0.5)) peers.push_back(player.get());
    if (!peers.empty()) peers.front()->think_together(peers, 1 + static_cast<unsigned>(t % 3));
    const Move common = draw.chance(0.5) ? Move::C : Move::D;
    for (std::size_t i = 0; i < matches; ++i) {
      const Move own = together[i]->move();
      EXPECT_EQ(own, alone[i]->move());
      EXPECT_EQ(together[i]->belief(), alone[i]->belief());
      const Move theirs = t < i ? common : (draw.chance(0.5) ? Move::C : Move::D);
      together[i]->observe(own, theirs);
      alone[i]->observe(own, theirs);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Trainings, TransformerTest, ::testing::ValuesIn(test::trainings),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Transformer, RefusesWhatItWasNotTrainedFor) {
  const auto mind = test::playing_mind();
  const auto start = [&](const MatchStart& match, bool extrapolate) {
    transformer("sct:file", mind, {.extrapolate = extrapolate}).new_player()->start(match);
  };
  const auto other_game = parse_payoffs("T=7,R=3,P=1,S=0");
  const std::vector<std::pair<MatchStart, std::string>> foreign{
      {{other_game, Criterion::finite(14), {}}, "T=7,R=3,P=1,S=0"},
      {match_of(15), "15 rounds"},
      {{{}, Criterion::mean(), {}}, "mean"},
      {{{}, Criterion::discounted(0.9), {}}, "discounted:0.9"},
      {{{}, Criterion::ending(0.1), {}}, "ending:0.1"},
  };
  for (const auto& [match, what] : foreign) {
    test::expect_error<UsageError>([&, &match = match] { start(match, false); }, what);
    test::expect_error<UsageError>([&, &match = match] { start(match, false); }, "sct:file was trained on");
    test::expect_error<UsageError>([&, &match = match] { start(match, false); }, "--extrapolate");
    EXPECT_NO_THROW(start(match, true)) << what;
  }
  EXPECT_NO_THROW(start(match_of(14), false));
  EXPECT_NO_THROW(start(match_of(3), false));
}

TEST(Transformer, ExtrapolatesAnyNumberOfRoundsAndSaysSo) {
  const auto mind = test::playing_mind();
  const auto sct = transformer("sct", mind, {.extrapolate = true});
  EXPECT_NE(sct.caveat.find("sct extrapolates: it was trained on 14 rounds"), std::string::npos) << sct.caveat;
  const auto record = play_script(sct, match_of(60), 60, 1);
  for (const double belief : record.beliefs) EXPECT_TRUE(belief >= 0 && belief <= 1);
  const auto within = play_script(transformer("sct", mind), match_of(), trained_rounds, 1);
  for (std::size_t t = 0; t < trained_rounds; ++t) EXPECT_EQ(record.beliefs[t], within.beliefs[t]);
}

TEST(Transformer, AsksShorterMatchesForLess) {
  const auto mind = test::playing_mind();
  const auto short_match = play_script(transformer("sct", mind, {.target = 28}), match_of(7), 7, 3);
  EXPECT_EQ(short_match, play_script(transformer("sct", mind, {.target = 14}), match_of(14), 7, 3));
  EXPECT_NE(short_match, play_script(transformer("sct", mind, {.target = 28}), match_of(14), 7, 3));
  const auto usual = play_script(transformer("sct", mind), match_of(), 7, 3);
  EXPECT_EQ(usual, play_script(transformer("sct", mind, {.target = 42}), match_of(), 7, 3));
}

TEST(Transformer, CountsDownByTheGamesPayoffs) {
  auto policy = test::playing_policy({});
  policy.training.payoffs = parse_payoffs("T=50,R=30,P=10,S=0");
  policy.training.return_scale *= 10;
  policy.training.return_target *= 10;
  const auto scaled = transformer("sct", std::make_shared<const Mind>(policy));
  const auto record = play_script(scaled, {policy.training.payoffs, Criterion::finite(14), {}}, 14, 3);
  const auto usual = play_script(transformer("sct", test::playing_mind()), match_of(), 14, 3);
  EXPECT_EQ(record.moves, usual.moves);
  for (std::size_t t = 0; t < 14; ++t) EXPECT_NEAR(record.beliefs[t], usual.beliefs[t], 1e-5);
}

TEST(Transformer, SamplesByItsKey) {
  const auto sct = transformer("sct", test::playing_mind(), {.sample = true});
  EXPECT_FALSE(sct.deterministic);
  const auto play = [&](const RandomKey& key) { return play_script(sct, match_of(14, key), 14, 2).moves; };
  EXPECT_EQ(play({1, 2, 3, 0}), play({1, 2, 3, 0}));
  std::vector<std::vector<Move>> different;
  for (std::uint64_t repetition = 0; repetition < 20; ++repetition) {
    const auto moves = play({1, 2, repetition, 0});
    if (std::find(different.begin(), different.end(), moves) == different.end()) different.push_back(moves);
  }
  EXPECT_GT(different.size(), 5U);
}

/// In the first round, where nothing hangs on earlier draws: as often as the action head says.
TEST(Transformer, SamplesWithTheHeadsProbability) {
  const auto mind = test::playing_mind();
  const auto so_far = begin_match(4.2);
  const double p = Thinker(*mind).think(so_far).cooperation;
  const auto player = transformer("sct", mind, {.sample = true}).new_player();
  constexpr std::uint64_t matches = 2000;
  double cooperated = 0;
  for (std::uint64_t repetition = 0; repetition < matches; ++repetition) {
    player->start(match_of(14, {1, 1, repetition, 0}));
    cooperated += player->move() == Move::C ? 1 : 0;
  }
  const double expected = static_cast<double>(matches) * p;
  EXPECT_NEAR(cooperated, expected, 5 * std::sqrt(expected * (1 - p)));
}

TEST(Transformer, ActsOnAForcedBeliefButTellsItsOwn) {
  const auto mind = test::playing_mind();
  const auto believing = [&](std::optional<Move> belief) {
    const auto player = transformer("sct", mind, {.forced_belief = belief}).new_player();
    player->start(match_of());
    player->move();
    return player->belief();
  };
  EXPECT_EQ(believing(Move::C), believing(std::nullopt));
  EXPECT_EQ(believing(Move::D), believing(std::nullopt));
  std::size_t changed = 0;
  for (std::uint64_t script = 1; script <= 8; ++script) {
    const auto c = play_script(transformer("sct", mind, {.forced_belief = Move::C}), match_of(), 14, script).moves;
    const auto d = play_script(transformer("sct", mind, {.forced_belief = Move::D}), match_of(), 14, script).moves;
    changed += c == d ? 0U : 1U;
  }
  EXPECT_GT(changed, 0U);
}

TEST(RosterPlay, ScoresAsTheTournamentDoes) {
  const auto registry = Registry::standard();
  auto entrants = registry.roster("sct2025");
  const auto roster = entrants;
  const std::vector<Strategy> guests{transformer("sct", test::playing_mind()), registry.make("grudger"),
                                     transformer("madt", test::playing_mind(test::trainings.back(), 4))};
  Sampling sampling;
  sampling.criterion = Criterion::finite(trained_rounds);
  const auto scores = play_roster(guests, roster, sampling);
  for (const auto& guest : guests) entrants.push_back(guest);
  TournamentSettings settings;
  settings.criterion = sampling.criterion;
  const auto tournament = play_tournament(entrants, roster.size(), settings);
  for (std::size_t g = 0; g < guests.size(); ++g) {
    double total = 0;
    for (std::size_t i = 0; i < roster.size(); ++i) {
      EXPECT_EQ(scores[g].scores[i], tournament.score(roster.size() + g, i))
          << guests[g].name << " v " << roster[i].name;
      total += scores[g].scores[i];
    }
    EXPECT_EQ(scores[g].total, total);
  }
  ASSERT_TRUE(scores[0].belief_accuracy.has_value());
  EXPECT_GT(*scores[0].belief_accuracy, 0);
  EXPECT_LT(*scores[0].belief_accuracy, 1);
  EXPECT_FALSE(scores[1].belief_accuracy.has_value());
  EXPECT_FALSE(scores[2].belief_accuracy.has_value());
}

}  // namespace
}  // namespace folk::sct
