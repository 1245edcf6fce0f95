#include <folk/analysis/evolution/score_table.h>
#include <folk/analysis/tournament/csv_lines.h>
#include <folk/games/error.h>

#include <fmt/format.h>

namespace folk {

ScoreTable read_score_table(std::string_view text, const std::string& source) {
  ScoreTable table;
  CsvLines lines(text, source);
  std::size_t columns = 0;
  while (lines.next()) {
    auto fields = lines.fields();
    if (columns == 0) {
      columns = fields.size();
      if (columns > 2 && fields.back() == "total") fields.pop_back();
      if (fields.size() < 2) lines.refuse("expected a header row\\col,NAME,NAME,... of a table of scores");
      if (fields.size() - 1 > most_in_table)
        lines.refuse(fmt::format("{} strategies: expected at most {}", fields.size() - 1, most_in_table));
      table.names.assign(fields.begin() + 1, fields.end());
      continue;
    }
    const std::size_t row = table.rows.size();
    if (row >= table.names.size()) lines.refuse("more rows than columns: expected a row a strategy");
    if (fields.size() != columns)
      lines.refuse(fmt::format("{} fields: expected {} as in the header", fields.size(), columns));
    if (fields.front() != table.names[row])
      lines.refuse(fmt::format("row '{}': expected '{}', rows in the order of the columns", excerpt(fields.front()),
                               excerpt(table.names[row])));
    auto& scores = table.rows.emplace_back();
    for (std::size_t j = 0; j < table.names.size(); ++j) {
      try {
        scores.push_back(parse_rational(fields[j + 1]));
      } catch (const UsageError&) {
        lines.refuse(fmt::format("'{}' against '{}': expected a number (of a tournament with self-play)",
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
