#include <folk/analysis/tournament/csv_lines.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace folk {

CsvLines::CsvLines(std::string_view text, std::string source)
    : rest_(text),
      source_(std::move(source)) {}

void CsvLines::refuse(std::size_t line, std::string_view why) const {
  refuse_file(fmt::format("{}:{}", source_, line), why);
}

bool CsvLines::next() {
  while (!rest_.empty()) {
    const auto end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    split(line);
    return true;
  }
  return false;
}

void CsvLines::split(std::string_view line) {
  fields_.assign(1, {});
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == ',') {
      fields_.emplace_back();
    } else if (line[at] == '"' && fields_.back().empty()) {
      for (++at;; ++at) {
        if (at >= line.size()) refuse("a quote is not closed");
        if (line[at] != '"')
          fields_.back() += line[at];
        else if (at + 1 < line.size() && line[at + 1] == '"')
          fields_.back() += line[at++];
        else
          break;
      }
      if (at + 1 < line.size() && line[at + 1] != ',') refuse("text after a closing quote");
    } else {
      fields_.back() += line[at];
    }
  }
}

}  // namespace folk
