#include <folk/games/utf8.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace folk::tools {
namespace {

bool numeric(const std::string& cell) {
  return cell.empty() || cell == "-" || (cell.find_first_not_of("0123456789+-.,e%±/ ") == std::string::npos);
}

/// Characters, not bytes: the tables hold a few signs like ± in UTF-8.
std::size_t width(const std::string& cell) { return utf8_characters(cell).size(); }

std::vector<std::string> visible(std::vector<std::string> cells) {
  for (auto& cell : cells) cell = visible_text(cell);
  return cells;
}

}  // namespace

std::string visible_line(std::string_view line) {
  if (line.ends_with('\n')) line.remove_suffix(1);
  return visible_text(line) + "\n";
}

Table::Table(std::vector<std::string> header)
    : header_(visible(std::move(header))) {}

void Table::add(std::vector<std::string> row) { rows_.push_back(visible(std::move(row))); }

std::string Table::text() const {
  const std::size_t columns = header_.size();
  std::vector<std::size_t> widths(columns);
  std::vector<bool> right(columns, true);
  for (std::size_t c = 0; c < columns; ++c) {
    widths[c] = width(header_[c]);
    for (const auto& row : rows_) {
      widths[c] = std::max(widths[c], width(row[c]));
      if (!numeric(row[c])) right[c] = false;
    }
  }
  std::string text;
  const auto line = [&](const std::vector<std::string>& row) {
    std::string out;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::string pad(widths[c] - width(row[c]), ' ');
      if (c > 0) out += "  ";
      out += right[c] ? pad + row[c] : row[c] + pad;
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    text += out + "\n";
  };
  line(header_);
  for (const auto& row : rows_) line(row);
  return text;
}

}  // namespace folk::tools
