#pragma once
// The options that say which game is played: --payoffs and --game.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>
#include <folk/games/stage_game.h>

#include <array>
#include <string>

namespace folk::tools {

/// What is played, and its title as its author wrote it: text shows the beginning (shown_title).
struct ChosenGame {
  Payoffs payoffs;
  std::string title = "prisoner's dilemma";
  bool from_file = false;
  std::array<std::string, 2> actions{"C", "D"};  ///< what its author calls C and D
};

/// "C is Stag, D is Hare", where the actions have names of their own, else nothing.
std::string action_words(const ChosenGame& game);

/// Adds --payoffs and --game.
void add_game_options(po::options_description& options);

/// The game of a .nfg file; of "-", of the standard input. Throws UsageError, InputFileError.
StageGame read_game(const std::string& file);

/// What --game names, read; where the caller has put a StageGame there instead of a name, that one.
StageGame named_game(const po::variables_map& values);

/// What they say; the standard dilemma by default. Throws UsageError when both are given or the game is no symmetric
/// 2x2 game, InputFileError when the file makes no sense.
ChosenGame chosen_game(const po::variables_map& values);

/// A game's title as text and pictures show it, on one line: its first 200 characters.
std::string shown_title(const std::string& title);

/// The game as lines of text and captions name it: "prisoner's dilemma (T=5,R=3,P=1,S=0)".
std::string game_words(const std::string& title, const Payoffs& payoffs);

/// Says on stderr where a dilemma from --payoffs rewards taking turns to defect.
void note_unusual_payoffs(const ChosenGame& game, const Common& common);

}  // namespace folk::tools
