#pragma once
// Aligned columns for people.

#include <string>
#include <string_view>
#include <vector>

namespace folk::tools {

/// A line of text in which other people's words stand, its end included, as visible_text shows it.
std::string visible_line(std::string_view line);

/// Prints rows under a header; columns of numbers are right-aligned, others left. Cells are shown as visible_text.
class Table {
public:
  explicit Table(std::vector<std::string> header);
  void add(std::vector<std::string> row);
  std::string text() const;

private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace folk::tools
