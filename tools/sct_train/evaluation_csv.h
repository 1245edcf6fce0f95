#pragma once
// The evaluations of a training run as comma-separated values, a row each.

#include <folk/sct/training/selection.h>

#include <cstddef>
#include <string>
#include <vector>

namespace folk::tools {

/// The first line; with `held_out` there are two columns more.
std::string evaluation_heading(bool held_out);

std::string evaluation_row(const sct::Evaluation& evaluation, bool kept);

/// Heading and rows; `kept` is the index of the evaluation whose policy is kept.
std::string evaluation_table(const std::vector<sct::Evaluation>& history, std::size_t kept, bool held_out);

/// The same while a run lasts: marked are those whose policy was kept when they were made.
std::string evaluation_table_so_far(const std::vector<sct::Evaluation>& history, bool held_out);

}  // namespace folk::tools
