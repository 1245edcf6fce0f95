#pragma once
// The evaluations of a training run as the CSV that `mpe-train online` writes, read back to be drawn.

#include <folk/mpe/pictures/learning_curve.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace folk::mpe {

/// Columns "episodes" and `column` ("return" or "prey_return") of a CSV with a header, by their names; `source` (a
/// path) is what messages call it and the curve's name. Throws InputFileError "source:line: what; mend" when a column
/// is missing, a row has another number of fields, a number is none or not finite, or there is no row.
LearningCurve parse_curve(std::string_view text, const std::string& source, std::string_view column);

/// parse_curve of a file; its name without folder and extension is the curve's. Also throws InputFileError when it
/// cannot be read.
LearningCurve read_curve(const std::filesystem::path& path, std::string_view column);

}  // namespace folk::mpe
