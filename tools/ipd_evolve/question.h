#pragma once
// What is asked about a population, out of the options.

#include <folk/tools/program/program.h>

#include <folk/analysis/evolution/dynamics.h>
#include <folk/analysis/evolution/score_matrix.h>
#include <folk/analysis/evolution/selection_rules.h>

#include <cstdint>
#include <memory>
#include <string>

namespace folk::tools {

/// What becomes of a population; who takes over, by simulation; with which probability a mutant does; what rare
/// mutations come to.
enum class Question { evolution, runs, fixation, stationary };

struct EvolveQuestion {
  Question question = Question::evolution;
  std::string model;     ///< as --model says it
  DynamicsPtr dynamics;  ///< of evolution and runs
  Population start;      ///< likewise
  bool meets_itself = false;
  SelectionRules rules;             ///< of fixation and stationary, and of runs where `has_rules`
  bool has_rules = false;           ///< the model is birth-death or pairwise
  std::uint64_t individuals = 100;  ///< of fixation and stationary
  bool exact = false;
  std::uint64_t runs = 0;
  std::uint64_t generations = 1000;
};

/// Adds --model and all that belongs to it.
void add_question_options(po::options_description& options);

/// Throws UsageError on options that contradict each other or belong to another model, as far as that can be told
/// before anything is played.
void check_question(const po::variables_map& values);

/// What they say of these scores. Throws UsageError.
EvolveQuestion chosen_question(const po::variables_map& values, const std::shared_ptr<const ScoreMatrix>& scores);

}  // namespace folk::tools
