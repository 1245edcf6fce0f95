#pragma once
// What a training run is told: keys of its config file, which are also options of the command line.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>
#include <folk/sct/training/training_run.h>
#include <folk/tools/sct_train/config_keys.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace folk::tools {

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
