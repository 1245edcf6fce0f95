// read_score_table: whatever is read is square, is written and read back as the same, and makes a matrix or says why
// not.

#include <folk/analysis/evolution/score_table.h>

#include "fuzz.h"

namespace {

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) {
    const auto table = folk::read_score_table(text, "fuzz.csv");
    std::string written = "row\\col";
    for (const auto& name : table.names) written += "," + quoted(name);
    written += ",last\n";
    for (std::size_t i = 0; i < table.names.size(); ++i) {
      folk::fuzz::require(table.rows[i].size() == table.names.size());
      written += quoted(table.names[i]);
      for (const auto& score : table.rows[i]) written += "," + score.str();
      written += ",x\n";
    }
    written.replace(written.find(",last\n"), 6, ",total\n");
    const auto back = folk::read_score_table(written, "fuzz.csv");
    folk::fuzz::require(back.names == table.names && back.rows == table.rows);
    const folk::ScoreMatrix scores(table.names, table.rows, 1);
    for (std::size_t i = 0; i < scores.size(); ++i)
      for (std::size_t j = 0; j < scores.size(); ++j)
        folk::fuzz::require(!scores.exact() || scores.exact_payoff(i, j) == table.rows[i][j]);
  });
}
