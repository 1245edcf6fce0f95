#pragma once
// What a training run learns from, as its config names it.

#include <folk/tools/sct_train/config.h>

#include <folk/sct/data/exploration.h>
#include <folk/sct/data/windows.h>
#include <folk/sct/training/aggregation.h>
#include <folk/strategies/strategy.h>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace folk::tools {

/// What a run learns from at its beginning, and who labels what it meets later.
struct TrainData {
  std::vector<sct::Lesson> lessons;                     ///< none where it explores
  std::set<std::string> opponents;                      ///< whom the players of the lessons met; "": one without a name
  std::shared_ptr<const sct::BayesTeacher> teacher;     ///< null where the config has none
  std::shared_ptr<const sct::Exploration> exploration;  ///< null where it does not explore
};

/// The lessons of config.data; settles the config by their rounds. `best-reply` is the play of the best replies and of
/// the Bayes-optimal player, without and with slips of its own, all labelled by the teacher for the lowest target.
/// Throws UsageError and what reading a folder throws.
TrainData train_data(TrainConfig& config, const std::vector<Strategy>& roster);

/// A signature of all lessons: two runs with the same settings and signature are the same.
std::uint64_t signature_of(const std::vector<sct::Lesson>& lessons);

}  // namespace folk::tools
