#pragma once
// A training run as a file: all that is needed to go on as if it had never stopped.
//
//   8 bytes "FOLKCKPT", a word with the version, the sections of Checkpoint in their order, a word with a checksum
//
// Words and numbers are little endian; texts and lists begin with a word that holds their length.

#include <folk/sct/data/windows.h>
#include <folk/sct/training/selection.h>
#include <folk/sct/training/trainer.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace folk::sct {

/// The losses of some steps, added up.
struct LossSums {
  double belief = 0;
  double action = 0;
  std::uint64_t steps = 0;

  void add(const Losses& losses);
  double mean_belief() const { return steps == 0 ? 0 : belief / static_cast<double>(steps); }
  double mean_action() const { return steps == 0 ? 0 : action / static_cast<double>(steps); }

  bool operator==(const LossSums&) const = default;
};

/// What a run is at some step. Random numbers have no state: a step draws them from the seed and its number.
struct Checkpoint {
  std::string run;  ///< all that the run depends on, one "key = value" a line
  TrainingState training;
  LossSums losses;                     ///< since the last evaluation
  std::vector<Lesson> added;           ///< lessons beside those of the data
  std::vector<Evaluation> history;     ///< by step
  std::uint64_t kept = 0;              ///< index of the evaluation whose policy is kept, where there is a history
  std::vector<float> kept_parameters;  ///< its policy's; empty without a history
};

/// Throws UsageError when a number is not finite: training has diverged.
std::string checkpoint_bytes(const Checkpoint& checkpoint);

/// Reads what checkpoint_bytes wrote; `source` (a path) is what messages call it. Nothing in it is taken on trust, and
/// no more memory is asked for than the bytes account for. Whether it fits a network is Trainer::restore's to say.
/// Throws InputFileError "source: what; mend".
Checkpoint parse_checkpoint(std::string_view bytes, const std::string& source);

/// How the run of a checkpoint differs from the one that would go on with it: the first line that is not the same in
/// both, as "learning-rate = 0.001 there, 0.0001 here"; empty when they are the same.
std::string difference_of_runs(std::string_view there, std::string_view here);

}  // namespace folk::sct
