#pragma once
// The keys of a training's config: their values, how the text of each is taken, and how its value is written.

#include <folk/games/payoffs.h>
#include <folk/sct/training/training_run.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace folk::tools {

inline constexpr std::uint64_t most_training_steps = 1'000'000'000;
inline constexpr std::uint64_t most_training_rounds = 100'000;  // each may have a row of the time table

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

/// One key; `what` is what a message calls it. `set` throws UsageError for a text that it cannot have.
struct ConfigKey {
  std::string name;
  std::string help;
  std::function<void(TrainConfig&, const std::string& text, const std::string& what)> set;
  std::function<std::string(const TrainConfig&)> show;
};

/// In the order of the help.
const std::vector<ConfigKey>& config_keys();

/// "yes" (all the steps), "no" (0) or a number of steps. Throws UsageError.
std::uint64_t decay_steps(const std::string& text, std::uint64_t all, const std::string& what);

/// "260:360:20" (from, to, by) or "260,300,320", lowest first. Throws UsageError.
std::vector<double> parse_targets(const std::string& text, const std::string& what);

}  // namespace folk::tools
