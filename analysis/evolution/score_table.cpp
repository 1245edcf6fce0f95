#include <folk/analysis/evolution/score_table.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <utility>

namespace folk {
namespace {

[[noreturn]] void refuse_line(const std::string& source, std::size_t line, std::string_view why) {
  refuse_file(fmt::format("{}:{}", source, line), why);
}

/// The fields of a line; quotes around one are taken off, doubled ones inside are one.
std::vector<std::string> fields_of(std::string_view line, const std::string& source, std::size_t number) {
  std::vector<std::string> fields(1);
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == ',') {
      fields.emplace_back();
    } else if (line[at] == '"' && fields.back().empty()) {
      for (++at;; ++at) {
        if (at >= line.size()) refuse_line(source, number, "a quote is not closed");
        if (line[at] != '"')
          fields.back() += line[at];
        else if (at + 1 < line.size() && line[at + 1] == '"')
          fields.back() += line[at++];
        else
          break;
      }
      if (at + 1 < line.size() && line[at + 1] != ',') refuse_line(source, number, "text after a closing quote");
    } else {
      fields.back() += line[at];
    }
  }
  return fields;
}

}  // namespace

ScoreTable read_score_table(std::string_view text, const std::string& source) {
  ScoreTable table;
  std::size_t number = 0;
  std::size_t columns = 0;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    auto fields = fields_of(line, source, number);
    if (columns == 0) {
      columns = fields.size();
      if (columns > 2 && fields.back() == "total") fields.pop_back();
      if (fields.size() < 2)
        refuse_line(source, number, "expected a header row\\col,NAME,NAME,... of a table of scores");
      if (fields.size() - 1 > most_in_table)
        refuse_line(source, number,
                    fmt::format("{} strategies: expected at most {}", fields.size() - 1, most_in_table));
      table.names.assign(fields.begin() + 1, fields.end());
      continue;
    }
    const std::size_t row = table.rows.size();
    if (row >= table.names.size()) refuse_line(source, number, "more rows than columns: expected a row a strategy");
    if (fields.size() != columns)
      refuse_line(source, number, fmt::format("{} fields: expected {} as in the header", fields.size(), columns));
    if (fields.front() != table.names[row])
      refuse_line(source, number,
                  fmt::format("row '{}': expected '{}', rows in the order of the columns", excerpt(fields.front()),
                              excerpt(table.names[row])));
    auto& scores = table.rows.emplace_back();
    for (std::size_t j = 0; j < table.names.size(); ++j) {
      try {
        scores.push_back(parse_rational(fields[j + 1]));
      } catch (const UsageError&) {
        refuse_line(source, number,
                    fmt::format("'{}' against '{}': expected a number (of a tournament with self-play)",
                                excerpt(fields[j + 1]), excerpt(table.names[j])));
      }
    }
  }
  if (columns == 0) refuse_file(source, "no table of scores: expected a header row\\col,NAME,NAME,...");
  if (table.rows.size() != table.names.size())
    refuse_file(source, fmt::format("{} rows for {} columns: expected a row a strategy", table.rows.size(),
                                    table.names.size()));
  return table;
}

}  // namespace folk
