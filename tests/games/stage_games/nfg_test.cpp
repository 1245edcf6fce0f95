#include <folk/games/payoffs.h>
#include <folk/games/stage_games/nfg.h>
#include <folk/games/stage_games/reference_games.h>
#include <folk/games/text_file.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <unistd.h>

#include <filesystem>

#include "games/arbitrary.h"
#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;

// The outcome form, laid out as Gambit's writer does (blank after the last index included).
const std::string outcome_file =
    "NFG 1 R \"A \\\"small\\\" game\" { \"Anna\" \"Bert\" }\n\n"
    "{ { \"U\" \"D\" }\n{ \"l\" \"m\" \"r\" }\n}\n"
    "\"Two lines\nof comment\"\n\n"
    "{\n{ \"\" 2, 0 }\n{ \"\" 0, 1 }\n{ \"\" 1/3, 1 }\n{ \"\" -1, 0.5 }\n{ \"\" 7, 8 }\n{ \"\" 9, 10 }\n}\n"
    "1 2 3 4 5 6 \n";

// The payoff form, as Gambit writes a game that comes from a tree.
const std::string payoff_file =
    "NFG 1 R \"A \\\"small\\\" game\" { \"Anna\" \"Bert\" }\n\n"
    "{ { \"U\" \"D\" }\n{ \"l\" \"m\" \"r\" }\n}\n"
    "\"Two lines\nof comment\"\n\n"
    "2 0\n0 1\n1/3 1\n-1 0.5\n7 8\n9 10\n";

StageGame small_game() {
  return StageGame("A \"small\" game", {"Anna", "Bert"}, {{{"U", "D"}, {"l", "m", "r"}}},
                   {{2, 0}, {Rational(1, 3), 1}, {7, 8}, {0, 1}, {-1, Rational(1, 2)}, {9, 10}},
                   "Two lines\nof comment");
}

void expect_identical(const StageGame& a, const StageGame& b) {
  EXPECT_TRUE(a.same_game(b));
  EXPECT_EQ(a.title(), b.title());
  EXPECT_EQ(a.players(), b.players());
  EXPECT_EQ(a.comment(), b.comment());
}

TEST(Nfg, ReadsBothFormsWithTheFirstPlayersActionFastest) {
  expect_identical(read_nfg(outcome_file, "f"), small_game());
  expect_identical(read_nfg(payoff_file, "f"), small_game());
}

TEST(Nfg, WritesGambitsLayoutByteForByte) {
  EXPECT_EQ(write_nfg(read_nfg(outcome_file, "f"), NfgForm::outcome), outcome_file);
  EXPECT_EQ(write_nfg(read_nfg(payoff_file, "f"), NfgForm::payoff), payoff_file);
}

// The old one-line form: numbers of actions, no comment.
TEST(Nfg, ReadsNumberedActions) {
  const StageGame game =
      read_nfg("NFG 1 R \"Old\" { \"Player 1\" \"Player 2\" } { 3 2 }\n\n1 1 0 2 0 2 1 1 0 3 2 0 \n", "f");
  EXPECT_EQ(game.rows(), 3U);
  EXPECT_EQ(game.columns(), 2U);
  EXPECT_EQ(game.actions(Seat::first), (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_EQ(game.payoff(Seat::first, 2, 1), 2);
  EXPECT_EQ(game.payoff(Seat::second, 1, 1), 3);
  EXPECT_EQ(game.comment(), "");
}

TEST(Nfg, OutcomesMayBeSharedNamedNullAndWithoutCommas) {
  const StageGame game = read_nfg(
      "NFG 1 D \"t\" { \"\" \"\" } { { \"\" \"x\" } { \"1\" \"\" } }\n{ { \"win\" 1.5 -2.5, } { \"\" 3e1,4 } } 2 0 1 1",
      "f");
  EXPECT_EQ(game.actions(Seat::first), (std::vector<std::string>{"1", "x"}));
  EXPECT_EQ(game.actions(Seat::second), (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(game.payoff(Seat::first, 0, 0), 30);
  EXPECT_EQ(game.payoff(Seat::second, 0, 0), 4);
  EXPECT_EQ(game.payoff(Seat::first, 1, 0), 0);
  EXPECT_EQ(game.payoff(Seat::second, 1, 0), 0);
  EXPECT_EQ(game.payoff(Seat::first, 0, 1), Rational(3, 2));
  EXPECT_EQ(game.payoff(Seat::second, 1, 1), Rational(-5, 2));
}

// As Gambit's reader makes labels differ.
TEST(Nfg, ActionsOfOneNameAreNumbered) {
  const auto rows = [](const std::string& names, std::size_t count) {
    std::string payoffs;
    for (std::size_t i = 0; i < 2 * count; ++i) payoffs += " " + std::to_string(i);
    return read_nfg("NFG 1 R \"t\" { \"a\" \"b\" } { { " + names + " } { \"y\" } }" + payoffs, "f")
        .actions(Seat::first);
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(rows(R"("leave" "leave")", 2), (Names{"leave_1", "leave_2"}));
  EXPECT_EQ(rows(R"("x" "stay" "x" "x")", 4), (Names{"x_1", "stay", "x_2", "x_3"}));
  EXPECT_EQ(rows(R"("x" "x_1" "x")", 3), (Names{"x_2", "x_1", "x_3"}));
  EXPECT_EQ(rows(R"("2" "")", 2), (Names{"2_1", "2_2"}));
  EXPECT_EQ(rows(R"("x" "x" "x_1" "x_1")", 4), (Names{"x_2", "x_3", "x_1_1", "x_1_2"}));
}

TEST(Nfg, WhitespaceDoesNotMatter) {
  expect_identical(read_nfg("\xEF\xBB\xBFNFG\r\n1\tR\"t\"{\"a\"\"b\"}{{\"x\"}{\"y\"}}\r\n\r\n1\r\n2\r\n", "f"),
                   StageGame("t", {"a", "b"}, {{{"x"}, {"y"}}}, {{1, 2}}));
}

TEST(Nfg, BackslashesEscapeOnlyQuotesAndBackslashes) {
  const std::string file = R"(NFG 1 R "C:\dir \\ \" x\\" { "a" "b" } { 1 1 } 0 0)";
  EXPECT_EQ(read_nfg(file, "f").title(), R"(C:\dir \ " x\)");
}

RC_GTEST_PROP(Nfg, EveryGameIsReadBack, (const StageGame& game)) {
  for (const NfgForm form : {NfgForm::payoff, NfgForm::outcome}) {
    const std::string text = write_nfg(game, form);
    const StageGame back = read_nfg(text, "f");
    RC_ASSERT(back.same_game(game));
    RC_ASSERT(back.title() == game.title());
    RC_ASSERT(back.players() == game.players());
    RC_ASSERT(back.comment() == game.comment());
    RC_ASSERT(write_nfg(back, form) == text);
  }
}

RC_GTEST_PROP(Nfg, APrefixIsRefusedAndNamesALine, ()) {
  const auto cut = *rc::gen::inRange<std::size_t>(0, outcome_file.rfind("10 }"));
  try {
    read_nfg(outcome_file.substr(0, cut), "f.nfg");
    RC_FAIL("read");
  } catch (const InputFileError& error) {
    RC_ASSERT(std::string(error.what()).rfind("f.nfg:", 0) == 0);
  }
}

TEST(Nfg, ReferenceGamesAreReadBack) {
  for (const ReferenceGame& entry : reference_games()) {
    expect_identical(read_nfg(write_nfg(entry.game, NfgForm::outcome), "f"), entry.game);
    expect_identical(read_nfg(write_nfg(entry.game, NfgForm::payoff), "f"), entry.game);
  }
}

/// Expects a refusal of `text` with this whole message after "f.nfg:".
void refuses(const std::string& text, const std::string& message) {
  expect_error<InputFileError>([&] { read_nfg(text, "f.nfg"); }, "f.nfg:" + message);
}

TEST(Nfg, RefusesOtherFiles) {
  refuses("", "1: this is no .nfg file; it must begin with: NFG 1 R \"title\" { \"player 1\" \"player 2\" }");
  refuses("\n\nT=5,R=3", "3: this is no .nfg file");
  refuses("{\"json\": 1}", "1: this is no .nfg file");
  refuses("EFG 2 R \"tree\" { \"a\" \"b\" }",
          "1: an extensive game (EFG); save it from Gambit as a strategic game (.nfg)");
  refuses("NFG 2 R \"t\"", "1: '2' does not belong here; expected the version 1 after NFG");
  refuses("NFG 1 X \"t\"", "1: 'X' does not belong here; expected R or D after NFG 1");
  refuses("NFG 1 R t", "1: 't' does not belong here; expected the game's title in double quotes");
  refuses("NFG 1 R", "1: the file ends too soon; expected the game's title");
  refuses("NFG 1 R \"t\n\n", "1: the text that begins 't?\?' never ends; close it with \"");
}

TEST(Nfg, RefusesOtherNumbersOfPlayers) {
  refuses("NFG 1 R \"t\"\n{ \"a\" \"b\" \"c\" } { 2 2 2 }", "2: a game of 3 players; Folk plays games of two players");
  refuses("NFG 1 R \"t\"\n{ \"a\" } { 2 }\n1 2", "2: a game of 1 player; Folk plays games of two players");
  refuses("NFG 1 R \"t\" { } { }", "1: a game of 0 players");
  refuses("NFG 1 R \"t\" { a b }", "1: 'a' does not belong here; expected } after the players' names");
}

TEST(Nfg, RefusesWrongActions) {
  const std::string head = "NFG 1 R \"t\" { \"a\" \"b\" }\n";
  refuses(head + "{ { } { \"y\" } } 1 2", "2: a player without actions; name at least one");
  refuses(head + "{ { \"x\" } } 1 2", "2: '}' does not belong here; expected the number of a player's actions");
  refuses(head + "{ 1 1 1 } 1 2", "2: '1' does not belong here; expected } after the actions of the two players");
  for (const char* count : {"0", "-1", "1.5", "1e3", "1000001", "99999999999999999999", "+2"})
    refuses(head + "{ " + count + " 2 } 1 2",
            "2: '" + std::string(count) +
                "' cannot be the number of a player's actions; expected a whole number from 1 to 1000000");
  refuses(head + "{ 1000 1001 }", "2: a game of 1000 x 1001 actions; Folk reads games of up to 1000000 profiles");
  refuses(head + "{ 1000 1000 }\n1 1", "3: the rest of the file is too short for the payoffs of 1000 x 1000 actions");
}

TEST(Nfg, RefusesWrongPayoffs) {
  const std::string head = "NFG 1 R \"t\" { \"a\" \"b\" } { 2 1 } \"c\"\n";
  refuses(head + "1 2 3        ", "2: the file ends too soon; expected a payoff of the second player");
  refuses(head + "1 2\n3 4\n5", "4: '5' after the last of the game's payoffs; a 2x1 game needs no more, remove it");
  refuses(head + "1 2 3 four", "2: 'four' does not belong here; expected a payoff of the second player");
  refuses(head + "1 2 3 4x", "2: '4x' is not a number: write it as 3, -1.25, 2.5e-3 or 1/3");
  refuses(head + "1 2 3 1/0", "2: '1/0' divides by zero");
  refuses(head + "1, 2, 3, 4", "2: a comma between payoffs; separate them by blanks as Gambit does");
  refuses(head + "nan 1 2 3", "2: 'nan' does not belong here; expected the payoffs, or { and the list of outcomes");
  refuses(head + "\"twice\" 1 2 3 4", "2: 'twice' does not belong here; expected the payoffs");
}

TEST(Nfg, RefusesWrongOutcomes) {
  const std::string head = "NFG 1 R \"t\" { \"a\" \"b\" } { 2 1 }\n";
  refuses(head + "{ { \"\" 1, 2 } } 1 2",
          "2: '2' cannot be the number of a profile's outcome; expected a whole number from 0 to 1");
  refuses(head + "{ { \"\" 1, 2 } }\n1 -1", "3: '-1' cannot be the number of a profile's outcome");
  refuses(head + "{ { \"\" 1, 2 } } 1 0.5", "2: '0.5' cannot be the number");
  refuses(head + "{ { \"\" 1, 2 } } 1", "2: the file ends too soon; expected the number of a profile's outcome");
  refuses(head + "{ { \"\" 1, 2 } } 1 1 1", "2: '1' after the last of the game's payoffs");
  refuses(head + "{ { \"\" 1 } } 1 1", "2: '}' does not belong here; expected an outcome's two payoffs");
  refuses(head + "{ { \"\" 1, 2, 3 } } 1 1", "2: '3' does not belong here; expected } after an outcome's two payoffs");
  refuses(head + "{ { 1, 2 } } 1 1", "2: '1' does not belong here; expected an outcome's name in double quotes");
  refuses(head + "{ 1 2 } 1 1", "2: '1' does not belong here; expected } after the list of outcomes");
}

TEST(Nfg, ReadsTheLargestGame) {
  const StageGame game = read_nfg(
      "NFG 1 R \"large\" { \"a\" \"b\" } { 1000 1000 } { }" +
          [] {
            std::string zeros;
            for (int i = 0; i < 1'000'000; ++i) zeros += " 0";
            return zeros;
          }(),
      "f");
  EXPECT_EQ(game.rows() * game.columns(), most_nfg_profiles);
}

TEST(Nfg, ReadsFiles) {
  const auto path = std::filesystem::temp_directory_path() / ("folk-nfg-test-" + std::to_string(::getpid()) + ".nfg");
  write_file(path, outcome_file);
  expect_identical(read_nfg_file(path), small_game());
  write_file(path, "NFG 1 R \"t\"\n{ \"a\" }");
  expect_error<InputFileError>([&] { read_nfg_file(path); }, path.string() + ":2: a game of 1 player");
  std::filesystem::remove(path);
  expect_error<InputFileError>([&] { read_nfg_file(path); }, "no such file");
}

}  // namespace
}  // namespace folk
