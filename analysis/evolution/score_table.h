#pragma once
// A table of scores in a CSV file, as ipd-tournament writes it, as what a population is driven by.

#include <folk/analysis/evolution/score_matrix.h>

#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// Names, and a row of numbers for each.
struct ScoreTable {
  std::vector<std::string> names;
  std::vector<std::vector<Rational>> rows;
};

/// The most strategies of a table.
inline constexpr std::size_t most_in_table = 5000;

/// Reads CSV (RFC 4180, every record a line): a header "row\col,NAME,NAME,...", then a line a strategy, its name first,
/// in the order of the header, its score against each. Numbers are read exactly. A last column "total" is left out.
/// Throws InputFileError, naming `source` and the line.
ScoreTable read_score_table(std::string_view text, const std::string& source);

}  // namespace folk
