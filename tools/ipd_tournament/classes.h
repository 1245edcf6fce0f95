#pragma once
// Runs of ipd-tournament that play against a complete class without listing it.

#include <folk/tools/choices/game_option.h>
#include <folk/tools/ipd_tournament/class_output.h>
#include <folk/tools/program/program.h>

#include <folk/games/progress.h>
#include <folk/strategies/standard/memory_class.h>
#include <folk/strategies/strategy.h>

#include <optional>
#include <vector>

namespace folk::tools {

/// The class that is ranked as a whole: --strategies names it, alone, and it is too large to be listed or to be ranked
/// --by-behaviour. Throws UsageError where that is asked for and no class is named.
std::optional<MemoryClass> whole_class(const po::variables_map& values);

/// Ranks all members of a class. Throws UsageError where options ask for what only a listed roster has.
int rank_class(const MemoryClass& members, const po::variables_map& values, const Common& common);

/// Who is scored against which class.
struct ClassQuestion {
  ChosenGame game;
  MemoryClass members;
  ClassScoreSettings settings;
  std::vector<Strategy> entrants;
};

/// What --class, --entrants and the options of the play say. Throws UsageError, InputFileError.
ClassQuestion class_question(const po::variables_map& values, const Common& common);

/// Best first. Throws TooManyKinds where nobody has a score, and Cancelled.
ClassScores scored(const ClassQuestion& question, const Progress& progress);

/// Scores --entrants against --class.
int score_entrants(const po::variables_map& values, const Common& common);

}  // namespace folk::tools
