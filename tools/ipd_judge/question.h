#pragma once
// What ipd-judge is asked: the record, who may have played it against whom, and how often moves slip.

#include <folk/tools/choices/game_option.h>
#include <folk/tools/program/program.h>

#include <folk/analysis/judgement/judgement.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// All that the command line says.
struct JudgeQuestion : JudgementQuestion {
  std::string file;  ///< as it was named
  ChosenGame game;   ///< its payoffs are those of the question
  std::string players_spec;
  std::string opponents_spec;
  bool weighted = false;              ///< a SPEC has weights of its own
  std::vector<std::string> left_out;  ///< players whose chances nobody knows
  std::size_t shown = 10;             ///< rows of a table of text
  std::string command;                ///< the command line
  std::optional<std::filesystem::path> output;
};

void add_judge_options(Program& program);

/// Throws UsageError, InputFileError; makes the output folder.
JudgeQuestion judge_question(const po::variables_map& values, const Common& common);

}  // namespace folk::tools
