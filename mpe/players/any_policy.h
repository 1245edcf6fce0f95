#pragma once
// Policy files of every kind: their metadata say which.

#include <folk/mpe/players/player.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace folk::mpe {

/// The players of the policy in the bytes of a file: networks of single observations (policy_file.h), of windows
/// (window_policy.h), batch-constrained Q-learning's (bcq_policy.h) or a transformer (transformer_policy.h). `name` is
/// the controller's, `source` (a path) what messages call the file. Throws InputFileError for what is no such file, and
/// UsageError when it is for another scenario or side.
Controller any_policy_controller(std::string name, std::string_view bytes, const std::string& source, Side side,
                                 const Scenario& scenario);

/// True when the bytes call themselves a transformer of the particle world.
bool is_transformer(std::string_view bytes, const std::string& source);

}  // namespace folk::mpe
