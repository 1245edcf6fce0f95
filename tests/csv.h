#pragma once
// Golden tables under tests/data.

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace folk::test {

using Row = std::vector<std::string>;

/// All rows of tests/data/NAME, the header first. No field of these files is quoted.
inline std::vector<Row> read_csv(const std::string& name) {
  std::ifstream file(std::string(FOLK_SOURCE_DIR) + "/tests/data/" + name);
  if (!file) throw std::runtime_error("no tests/data/" + name);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::stringstream fields(line);
    Row row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace folk::test
