#include <folk/analysis/play/parallel.h>
#include <folk/analysis/replies/bayes_player.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/games/match.h>
#include <folk/games/outcome.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

namespace folk {
namespace {

Registry with_bayes() {
  Registry registry = Registry::standard();
  add_bayes(registry);
  return registry;
}

std::string name_of(const std::string& name) { return with_bayes().make(name).name; }

std::string refusal(const std::string& name, const Criterion& criterion = Criterion::finite(100)) {
  try {
    with_bayes().make(name).new_player()->start({{}, criterion, {}});
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

/// What a player earns in a match, and how often its likelier guess was right.
struct Seen {
  double total = 0;
  int right = 0;
  int rounds = 0;
};

Seen seen(const std::string& name, const std::string& opponent, std::uint64_t rounds = 100) {
  const auto registry = with_bayes();
  const auto player = registry.make(name).new_player();
  const auto other = registry.make(opponent).new_player();
  player->start({{}, Criterion::finite(rounds), {}});
  other->start({{}, Criterion::finite(rounds), {.role = 1}});
  Seen found;
  play_match(*player, *other, rounds, NoNoise{}, [&](Move own, Move theirs) {
    found.total += std::array{3, 0, 5, 1}[Outcome{own, theirs}.index()];
    found.right += likelier_move(*player->belief()) == theirs ? 1 : 0;
    ++found.rounds;
  });
  return found;
}

TEST(BayesPlayer, EarnsItsValueAgainstSct2025) {
  auto roster = with_bayes().roster("sct2025,bayes(sct2025)");
  TournamentSettings settings;
  settings.repetitions = 2;
  const auto tournament = play_tournament(std::move(roster), 17, settings);
  double total = 0;
  for (std::size_t j = 0; j < 17; ++j) total += tournament.score(17, j);
  EXPECT_EQ(total, 5160);
}

TEST(BayesPlayer, GuessesAlmostAlwaysRightOnSct2025) {
  const auto registry = with_bayes();
  const auto player = registry.make("bayes(sct2025)").new_player();
  int right = 0;
  for (const auto& member : registry.roster("sct2025")) {
    const auto other = member.new_player();
    player->start({});
    other->start({});
    play_match(*player, *other, 100, NoNoise{},
               [&](Move, Move theirs) { right += likelier_move(*player->belief()) == theirs ? 1 : 0; });
  }
  // 98.6 % of 1700: what is missed is mostly the opening, when nothing is known yet.
  EXPECT_EQ(right, 1676);
}

TEST(BayesPlayer, IsCalledByWhatItPlays) {
  EXPECT_EQ(name_of("bayes(Classics)"), "bayes(classics)");
  EXPECT_EQ(name_of("BAYES( tft , Grim )"), "bayes(tit_for_tat,spiteful)");
  EXPECT_EQ(name_of("bayes(classics;depth=3)"), "bayes(classics;depth=3)");
  EXPECT_EQ(name_of("bayes(classics; Depth = 3)"), "bayes(classics;depth=3)");
  EXPECT_EQ(name_of("bayes(GTFT(.3),all_d)"), "bayes(gtft(0.3),all_d;depth=5)");
  // A semicolon inside a member's own parentheses, and one of a member that ends the list.
  EXPECT_EQ(name_of("bayes(mem1(C;1,0,0.5,1),all_d;depth=2)"), "bayes(mem1(c;1,0,0.5,1),all_d;depth=2)");
  EXPECT_EQ(name_of("bayes(all_d,mem1(c;1,0,0,1))"), "bayes(all_d,mem1(c;1,0,0,1))");
  EXPECT_EQ(name_of("bayes(memory(1,2))"), "bayes(memory(1,2);depth=5)");
  EXPECT_EQ(name_of("bayes(MEM11_cCDDD)"), "bayes(mem11_cCDDD)");
  for (const char* name :
       {"bayes(classics)", "bayes(gtft(0.3),all_d;depth=5)", "bayes(mem1(c;1,0,0.5,1),all_d;depth=2)"})
    EXPECT_EQ(name_of(name), name);
}

TEST(BayesPlayer, RefusesWithTheMend) {
  EXPECT_NE(refusal("bayes(classics)", Criterion::mean()).find("bayes(classics;depth=5)"), std::string::npos);
  EXPECT_NE(refusal("bayes(gradual)", Criterion::finite(100'000)).find("bayes(gradual;depth=5)"), std::string::npos);
  EXPECT_NE(refusal("bayes(classics;depth=11)").find("11"), std::string::npos);
  EXPECT_NE(refusal("bayes(classics;depth=1.5)").find("whole"), std::string::npos);
  EXPECT_NE(refusal("bayes(exec:\"cat\")").find("opaque"), std::string::npos);
  EXPECT_NE(refusal("bayes()").find("empty"), std::string::npos);
  EXPECT_NE(refusal("bayes(pavlow)").find("pavlov"), std::string::npos);
  // It knows the registry as it was before it came.
  EXPECT_NE(refusal("bayes(bayes(classics))").find("unknown"), std::string::npos);
  EXPECT_EQ(refusal("bayes(classics;depth=3)", Criterion::mean()), "");
}

TEST(BayesPlayer, LooksAheadUnderAnyCriterion) {
  const auto registry = with_bayes();
  for (const auto& criterion : {Criterion::discounted(0.9), Criterion::mean(), Criterion::finite(50)}) {
    const auto player = registry.make("bayes(spiteful,all_d;depth=5)").new_player();
    player->start({{}, criterion, {}});
    EXPECT_EQ(player->move(), Move::C) << criterion.to_string();
    EXPECT_EQ(player->belief(), 0.5);
    player->observe(Move::C, Move::D);
    EXPECT_EQ(player->move(), Move::D);
    EXPECT_EQ(player->belief(), 0);
  }
  // In the last round there is nothing ahead.
  const Seen grim = seen("bayes(spiteful;depth=5)", "spiteful", 10);
  EXPECT_EQ(grim.total, 9 * 3 + 5);
  EXPECT_EQ(grim.right, 10);
}

TEST(BayesPlayer, ForgivesAMixerThatItKnows) {
  // Generous tit_for_tat forgives, all_d does not: a D tells them apart only slowly.
  const Seen seen_d = seen("bayes(gtft(0.3),all_d)", "all_d");
  EXPECT_GE(seen_d.total, 90);
  const Seen seen_gtft = seen("bayes(gtft(0.3),all_d)", "gtft(0.3)");
  EXPECT_GE(seen_gtft.total, 200);
}

TEST(BayesPlayer, RepeatsTheirMoveWhenNobodyIsLeft) {
  for (const char* name : {"bayes(all_c,all_d)", "bayes(all_c,all_d;depth=2)"}) {
    const auto player = with_bayes().make(name).new_player();
    player->start({});
    player->move();
    player->observe(Move::D, Move::C);
    EXPECT_EQ(player->move(), Move::D) << name;
    EXPECT_EQ(player->belief(), 1);
    player->observe(Move::D, Move::D);
    EXPECT_EQ(player->move(), Move::D);
    EXPECT_EQ(player->belief(), 0.5);
    player->observe(Move::D, Move::C);
    EXPECT_EQ(player->move(), Move::C);
    EXPECT_EQ(player->belief(), 0.5);
    // A new match is a new opponent.
    player->start({});
    player->move();
    EXPECT_EQ(player->belief(), 0.5);
    player->observe(Move::D, Move::D);
    player->move();
    EXPECT_EQ(player->belief(), 0);
  }
}

TEST(BayesPlayer, ThreadsShareOneSolution) {
  const Strategy strategy = with_bayes().make("bayes(classics)");
  std::array<double, 8> beliefs{};
  parallel_for(8, 4, [&](std::size_t i, unsigned) {
    const auto player = strategy.new_player();
    player->start({{}, Criterion::finite(i % 2 == 0 ? 10 : 12), {}});
    player->move();
    beliefs[i] = *player->belief();
  });
  for (const double belief : beliefs) EXPECT_DOUBLE_EQ(belief, 12.0 / 17);
}

TEST(BayesPlayer, IsDescribed) {
  const auto registry = with_bayes();
  EXPECT_EQ(registry.describe("bayes(classics)").name, "bayes(SPEC;depth=H)");
  EXPECT_TRUE(registry.make("bayes(classics)").deterministic);
}

TEST(BayesPlayer, KnowsLabelsAndNumbersAsPeopleWriteThem) {
  const auto registry = with_bayes();
  EXPECT_EQ(registry.make("bayes(hard=random(2/6),Tit For Tat;depth=2e0)").name,
            "bayes(hard=random(1/3),tit_for_tat;depth=2)");
  EXPECT_EQ(registry.make("x=bayes(tft,all_d)").name, "x");
  EXPECT_THROW(registry.make("bayes(tft;depth=1.5)"), UsageError);
}

TEST(BayesPlayer, ACloneGoesOnAlone) {
  const auto registry = with_bayes();
  for (const char* name : {"bayes(tit_for_tat,all_d,all_c)", "bayes(tit_for_tat,all_d,all_c;depth=3)"}) {
    const auto player = registry.make(name).new_player();
    player->start({{}, Criterion::finite(20), {}});
    player->move();
    player->observe(Move::C, Move::C);
    const auto copy = player->clone();
    ASSERT_NE(copy, nullptr);
    player->move();
    player->observe(Move::C, Move::D);  // nobody of the roster plays so
    copy->move();
    copy->observe(Move::C, Move::C);
    player->move();
    copy->move();
    EXPECT_EQ(*player->belief(), 0.5) << name;
    EXPECT_EQ(*copy->belief(), 1) << name;
  }
}

}  // namespace
}  // namespace folk
