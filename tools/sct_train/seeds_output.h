#pragma once
// Training runs that differ in their seed alone, as one table.

#include <folk/tools/sct_train/train_report.h>

#include <ostream>
#include <vector>

namespace folk::tools {

/// Settings, a row a seed, and mean and spread over the seeds.
void write_seeds_text(std::ostream& out, const std::vector<TrainReport>& reports);

/// A line a seed.
void write_seeds_csv(std::ostream& out, const std::vector<TrainReport>& reports);

/// One object; docs/sct-train.md says what it holds.
void write_seeds_json(std::ostream& out, const std::vector<TrainReport>& reports);

}  // namespace folk::tools
