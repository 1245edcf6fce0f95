#pragma once
// What a training run is told: keys of its config file, which are also options of the command line.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>
#include <folk/sct/training/training_run.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace folk::tools {

/// Every key with its default.
struct TrainConfig {
  std::string data = "tournament";  ///< or "best-reply", "explore", or a folder
  std::string roster = "sct2025";
  std::uint64_t rounds = 0;   ///< 0: not given
  std::string game = "none";  ///< or a .nfg file, whose payoffs and actions these are then
  Payoffs payoffs;
  bool payoffs_given = false;
  std::array<std::string, 2> actions{"C", "D"};
  std::uint64_t data_repetitions = 1;
  double regret_temperature = 0;  ///< 0: all moves of the data weigh the same
  double situation_temperature = 20;
  std::uint64_t aggregate_every = 0;
  std::uint64_t aggregate_repetitions = 4;
  double aggregate_slip = 0.05;
  std::string opponents = "roster";  ///< or a SPEC with weights: whom explored matches are against
  double opponent_slip = 0.002;
  std::uint64_t explore_every = 50;
  std::uint64_t explore_matches = 400;
  std::uint64_t remembered = 1;
  std::uint64_t time_rows = 0;         ///< 0: as many as rounds
  std::string return_token = "shown";  ///< or "hidden"
  std::uint64_t plan_depth = 0;
  std::string loss = "teacher";
  std::string decay = "no";
  std::string targets;      ///< empty: usual_targets
  double return_scale = 0;  ///< 0: 20 times the range of the payoffs, 100 in the standard dilemma
  std::uint64_t checkpoint_every = 100;
  /// All but architecture.time_rows, mode, decay_steps and the scale of returns, which follow from the rest.
  sct::TrainingSettings training;
  std::uint64_t steps = 10'000;
  std::uint64_t evaluate_every = 250;
  double validation_noise = 0;
  std::uint64_t validation_repetitions = 1;
  std::uint64_t validation_seed = 1'000'003;
  std::string held_out = "none";  ///< or a SPEC
  std::uint64_t patience = 0;     ///< evaluations; 0: without end

  /// A Bayes-optimal teacher labels the data, or part of them.
  bool has_teacher() const { return data == "best-reply" || aggregate_every > 0; }

  bool explores() const { return data == "explore"; }
  bool data_is_folder() const { return data != "tournament" && data != "best-reply" && !explores(); }

  /// The SPEC of whom explored matches are against.
  const std::string& met() const { return opponents == "roster" ? roster : opponents; }

  bool holds_out() const { return held_out != "none"; }

  /// The payoffs and the names of the actions came from a file.
  bool has_game() const { return game != "none"; }
};

/// Adds an option for each key, its help with the default.
void add_train_options(po::options_description& options);

/// The defaults, then the file's lines "key = value" ('#' begins a comment), then the options that are given.
/// Throws InputFileError "FILE:LINE: ..." and UsageError. The seed is checked by with_seed.
TrainConfig train_config(const po::variables_map& values, const std::filesystem::path& file);

/// The config with this seed. Throws UsageError when the evaluations draw from the same.
TrainConfig with_seed(TrainConfig config, std::uint64_t seed);

/// The returns to ask for where none are given, "FROM:TO:BY": a round from b - 0.08 w to b + 0.12 w, no more than the
/// game can pay, by 0.04 w. b is the most that both can have on average (both C, both D, or C and D in turn), w the
/// range of the payoffs: 2.6 to 3.6 by 0.2 in the standard dilemma. Throws UsageError for payoffs that are all the
/// same.
std::string usual_targets(const Payoffs& payoffs, std::uint64_t rounds);

/// Fills in what follows from the payoffs and the rounds of the data's matches. Throws UsageError when the config says
/// another number of rounds.
void settle(TrainConfig& config, std::uint64_t rounds);

/// The keys as a file that says the same, one "key = value" a line.
std::vector<std::pair<std::string, std::string>> key_values(const TrainConfig& config);

/// What follows from the config: the network's settings, and the run's but for its description.
sct::TrainingSettings training_settings(const TrainConfig& config, unsigned threads);
sct::RunSettings run_settings(const TrainConfig& config, unsigned threads);

/// The returns that are asked for in the evaluations, lowest first.
std::vector<double> targets_of(const TrainConfig& config);

}  // namespace folk::tools
