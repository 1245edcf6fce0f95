#include <folk/games/stage_games/reference_games.h>
#include <folk/games/stage_games/stage_equilibria.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "games/expect_error.h"

namespace folk {
namespace {

namespace fs = std::filesystem;
using test::expect_error;

std::vector<std::string> names(std::size_t actions) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < actions; ++i) all.push_back(std::to_string(i + 1));
  return all;
}

StageGame game_of(std::size_t rows, std::size_t columns, std::vector<std::array<Rational, 2>> payoffs) {
  return StageGame("", {"Row", "Column"}, {names(rows), names(columns)}, std::move(payoffs));
}

TEST(StageEquilibria, OfTheReferenceGames) {
  for (const ReferenceGame& entry : reference_games()) {
    const StageEquilibria found = stage_equilibria(entry.game);
    EXPECT_TRUE(std::is_permutation(found.extreme.begin(), found.extreme.end(), entry.equilibria.begin(),
                                    entry.equilibria.end()))
        << entry.name;
    EXPECT_FALSE(found.degenerate) << entry.name;
  }
}

TEST(StageEquilibria, PureOnesFirst) {
  const auto found = stage_equilibria(reference_game("chicken").game).extreme;
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0], (MixedProfile{{1, 0}, {0, 1}}));
  EXPECT_EQ(found[1], (MixedProfile{{0, 1}, {1, 0}}));
  EXPECT_EQ(found[2], (MixedProfile{{{2, 3}, {1, 3}}, {{2, 3}, {1, 3}}}));
  EXPECT_TRUE(is_pure(found[1]));
  EXPECT_FALSE(is_pure(found[2]));
}

// Nobody minds: every pair of mixtures is an equilibrium, the four pure ones span them.
TEST(StageEquilibria, DegenerateGamesAreSaidToBeSo) {
  const auto all = stage_equilibria(game_of(2, 2, {{0, 0}, {0, 0}, {0, 0}, {0, 0}}));
  EXPECT_TRUE(all.degenerate);
  EXPECT_EQ(all.extreme.size(), 4U);
  // Column's second reply ties at row's first action: (1, any q <= 1/2) is a component of two extreme points.
  const auto tie = stage_equilibria(game_of(2, 2, {{1, 1}, {1, 1}, {0, 0}, {2, 1}}));
  EXPECT_TRUE(tie.degenerate);
  EXPECT_EQ(tie.extreme, (std::vector<MixedProfile>{{{1, 0}, {1, 0}}, {{0, 1}, {0, 1}}, {{1, 0}, {{1, 2}, {1, 2}}}}));
  EXPECT_FALSE(stage_equilibria(game_of(1, 1, {{0, 0}})).degenerate);
  EXPECT_TRUE(stage_equilibria(game_of(1, 2, {{0, 0}, {0, 0}})).degenerate);
}

TEST(StageEquilibria, RefusesLargeGames) {
  expect_error<UsageError>([] { stage_equilibria(game_of(1, 20, std::vector<std::array<Rational, 2>>(20))); },
                           "at most 20 actions, both players' together: this one has 21");
  // Coordination on ten actions: each set of them gives one equilibrium.
  std::vector<std::array<Rational, 2>> payoffs(100);
  for (std::size_t i = 0; i < 10; ++i) payoffs[11 * i] = {1, 1};
  EXPECT_EQ(stage_equilibria(game_of(10, 10, payoffs)).extreme.size(), 1023U);
}

// ---- Agreement with lrsnash (Avis, Rosenberg, Savani & von Stengel 2009) --------------------------------------------

using ProfileSet = std::set<std::pair<MixedAction, MixedAction>>;

/// A third of them with payoffs of 0 and 1 alone, which are mostly degenerate.
StageGame random_game(std::mt19937& random, std::size_t number) {
  const std::size_t rows = 2 + random() % 4;
  const std::size_t columns = 2 + random() % 4;
  const auto most = std::array<std::uint32_t, 3>{2, 9, 100}[number % 3];
  std::vector<std::array<Rational, 2>> payoffs(rows * columns);
  for (auto& pair : payoffs) pair = {Rational(random() % most), Rational(random() % most)};
  return game_of(rows, columns, std::move(payoffs));
}

std::string as_lrs_input(const StageGame& game) {
  std::string text = std::to_string(game.rows()) + " " + std::to_string(game.columns()) + "\n";
  for (const Seat seat : both_seats)
    for (std::size_t i = 0; i < game.rows(); ++i)
      for (std::size_t j = 0; j < game.columns(); ++j)
        text += to_text(game.payoff(seat, i, j)) + (j + 1 < game.columns() ? " " : "\n");
  return text;
}

/// A block of its answer lists mixtures of player 2 (lines "2 ...") and of player 1, every pair an equilibrium; the
/// last number of a line is a payoff. A line "=" ends a game's answer.
std::vector<ProfileSet> parse_answers(std::istream& in) {
  std::vector<ProfileSet> answers(1);
  std::array<std::vector<MixedAction>, 2> block;
  for (std::string line; std::getline(in, line);) {
    if (line == "=") answers.emplace_back();
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word != "1" && word != "2") {
      for (const auto& row : block[0])
        for (const auto& column : block[1]) answers.back().insert({row, column});
      block = {};
      continue;
    }
    MixedAction numbers;
    for (std::string number; words >> number;) numbers.push_back(parse_rational(number));
    numbers.pop_back();
    block[word == "1" ? 0 : 1].push_back(std::move(numbers));
  }
  answers.pop_back();
  return answers;
}

/// What lrsnash answers to all the games, one shell for all of them.
std::vector<ProfileSet> lrsnash_answers(const std::vector<StageGame>& games) {
  const fs::path folder = fs::temp_directory_path() / ("folk_lrsnash_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  for (std::size_t i = 0; i < games.size(); ++i) std::ofstream(folder / std::to_string(i)) << as_lrs_input(games[i]);
  const std::string command = "cd '" + folder.string() + "' && for i in $(seq 0 " + std::to_string(games.size() - 1) +
                              "); do lrsnash $i; echo; echo =; done > answers 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream in(folder / "answers");
  auto answers = parse_answers(in);
  fs::remove_all(folder);
  return answers;
}

TEST(StageEquilibria, AgreeWithLrsnash) {
  if (std::system("command -v lrsnash > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "lrsnash is not installed: install the Debian package lrslib to compare the equilibria with its";
  std::mt19937 random(2009);
  std::vector<StageGame> games;
  for (std::size_t i = 0; i < 500; ++i) games.push_back(random_game(random, i));
  const auto answers = lrsnash_answers(games);
  ASSERT_EQ(answers.size(), games.size());
  std::size_t degenerate = 0;
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < games.size(); ++i) {
    const StageEquilibria found = stage_equilibria(games[i]);
    ProfileSet profiles;
    for (const auto& profile : found.extreme) profiles.insert({profile.row, profile.column});
    EXPECT_EQ(profiles.size(), found.extreme.size());
    EXPECT_EQ(profiles, answers[i]) << as_lrs_input(games[i]);
    // Wilson (1971): a nondegenerate game has an odd number.
    EXPECT_TRUE(found.degenerate || found.extreme.size() % 2 == 1) << as_lrs_input(games[i]);
    degenerate += found.degenerate ? 1U : 0U;
    mixed += is_pure(found.extreme.back()) ? 0U : 1U;
  }
  EXPECT_GT(degenerate, 100U);
  EXPECT_LT(degenerate, 400U);
  EXPECT_GT(mixed, 100U);
}

}  // namespace
}  // namespace folk
