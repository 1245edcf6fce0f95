#pragma once
// What sce-check is asked: the policy, its opponents, and what counts as an equilibrium.

#include <folk/tools/choices/game_option.h>
#include <folk/tools/program/program.h>

#include <folk/analysis/equilibria/certificate.h>
#include <folk/games/criterion.h>
#include <folk/sct/policy/thinker.h>
#include <folk/strategies/strategy.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// All that the command line says, with the defaults that a policy's metadata gives.
struct SceQuestion {
  Strategy policy;
  std::shared_ptr<const sct::Mind> mind;  ///< of a transformer; else null
  ChosenGame game;
  std::vector<Strategy> opponents;
  std::string opponents_spec;
  std::vector<Strategy> beliefs;  ///< the class of notion (b)
  std::string class_spec;
  Criterion criterion = Criterion::finite(100);
  Sides sides = Sides::both;
  double epsilon_belief = 0.05;
  Rational epsilon_payoff = 0;
  std::size_t depth = 6;  ///< of the search on the policy's own beliefs
  unsigned horizon = 0;
  bool extract = false;
  std::optional<std::string> require;
  std::optional<std::filesystem::path> output;
  std::uint64_t repetitions = 100;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

void add_sce_options(Program& program);

/// Throws UsageError, InputFileError; makes the output folder.
SceQuestion sce_question(const po::variables_map& values);

}  // namespace folk::tools
