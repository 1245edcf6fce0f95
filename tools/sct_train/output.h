#pragma once
// A finished training run as text, CSV and JSON.

#include <folk/tools/sct_train/train_report.h>

#include <ostream>
#include <string>

namespace folk::tools {

/// The game and what its actions are called, a line; nothing where no file says so.
std::string game_line(const TrainConfig& config);

/// Settings, the evaluations as a table, the kept policy against each opponent.
void write_text(std::ostream& out, const TrainReport& report);

/// A line an evaluation.
void write_csv(std::ostream& out, const TrainReport& report);

/// One object; docs/sct-train.md says what it holds.
void write_json(std::ostream& out, const TrainReport& report);

}  // namespace folk::tools
