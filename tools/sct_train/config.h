#pragma once
// What a training run is told: keys of its config file, which are also options of the command line.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>
#include <folk/sct/training/training_run.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace folk::tools {

/// Every key with its default.
struct TrainConfig {
  std::string data = "tournament";  ///< or "best-reply", or a folder
  std::string roster = "sct2025";
  std::uint64_t rounds = 0;  ///< 0: not given
  Payoffs payoffs;
  std::uint64_t data_repetitions = 1;
  double regret_temperature = 0;  ///< 0: all moves of the data weigh the same
  double situation_temperature = 20;
  std::uint64_t aggregate_every = 0;
  std::uint64_t aggregate_repetitions = 4;
  double aggregate_slip = 0.05;
  std::string loss = "teacher";
  std::string decay = "no";
  std::string targets;  ///< empty: 2.6 to 3.6 a round
  std::uint64_t checkpoint_every = 100;
  sct::TrainingSettings training;  ///< all but architecture.time_rows, mode and decay_steps, which follow from the rest
  std::uint64_t steps = 10'000;
  std::uint64_t evaluate_every = 250;
  double validation_noise = 0;
  std::uint64_t validation_repetitions = 1;
  std::uint64_t validation_seed = 1'000'003;
  std::string held_out = "none";  ///< or a SPEC
  std::uint64_t patience = 0;     ///< evaluations; 0: without end

  /// A Bayes-optimal teacher labels the data, or part of them.
  bool has_teacher() const { return data == "best-reply" || aggregate_every > 0; }

  bool data_is_folder() const { return data != "tournament" && data != "best-reply"; }

  bool holds_out() const { return held_out != "none"; }
};

/// Adds an option for each key, its help with the default.
void add_train_options(po::options_description& options);

/// The defaults, then the file's lines "key = value" ('#' begins a comment), then the options that are given.
/// Throws InputFileError "FILE:LINE: ..." and UsageError. The seed is checked by with_seed.
TrainConfig train_config(const po::variables_map& values, const std::filesystem::path& file);

/// The config with this seed. Throws UsageError when the evaluations draw from the same.
TrainConfig with_seed(TrainConfig config, std::uint64_t seed);

/// Fills in what follows from the rounds of the data's matches. Throws UsageError when the config says another number.
void settle(TrainConfig& config, std::uint64_t rounds);

/// The keys as a file that says the same, one "key = value" a line.
std::vector<std::pair<std::string, std::string>> key_values(const TrainConfig& config);

/// What follows from the config: the network's settings, and the run's but for its description.
sct::TrainingSettings training_settings(const TrainConfig& config, unsigned threads);
sct::RunSettings run_settings(const TrainConfig& config, unsigned threads);

/// The returns that are asked for in the evaluations, lowest first.
std::vector<double> targets_of(const TrainConfig& config);

}  // namespace folk::tools
