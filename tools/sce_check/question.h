#pragma once
// What sce-check is asked: the policy, its opponents, and what counts as an equilibrium.

#include <folk/tools/choices/game_option.h>
#include <folk/tools/program/program.h>

#include <folk/analysis/equilibria/examination_question.h>
#include <folk/sct/policy/thinker.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace folk::tools {

/// All that the command line says, with the defaults that a policy's metadata gives.
struct SceQuestion : ExaminationQuestion {
  std::shared_ptr<const sct::Mind> mind;  ///< of a transformer; else null
  ChosenGame game;                        ///< as it was named; its payoffs are those of the question
  std::string opponents_spec;
  std::string class_spec;
  bool settled = false;  ///< also ask from which round on each notion holds
  bool extract = false;
  std::optional<std::string> require;
  std::vector<std::string> left_out;  ///< of the default opponents: those that the criterion cannot judge
  std::string command;                ///< the command line
  std::optional<std::filesystem::path> output;
};

void add_sce_options(Program& program);

/// Throws UsageError, InputFileError; makes the output folder.
SceQuestion sce_question(const po::variables_map& values, const Common& common);

}  // namespace folk::tools
