#pragma once
// A finished training run as a JSON object, for those who print one or several.

#include <folk/tools/sct_train/train_report.h>

#include <nlohmann/json.hpp>
#include <optional>

namespace folk::tools {

using Json = nlohmann::ordered_json;

/// null where there is none.
Json number_json(const std::optional<double>& value);

/// Every key with its value.
Json config_json(const TrainConfig& config);

/// All that is told of a run but for its config.
Json report_json(const TrainReport& report);

}  // namespace folk::tools
