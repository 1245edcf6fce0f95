#pragma once
// Aligned columns for people.

#include <string>
#include <vector>

namespace folk::tools {

/// Prints rows under a header; columns of numbers are right-aligned, others left.
class Table {
public:
  explicit Table(std::vector<std::string> header)
      : header_(std::move(header)) {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string text() const;

private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace folk::tools
