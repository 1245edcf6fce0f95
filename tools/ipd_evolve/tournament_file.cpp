#include <folk/tools/ipd_evolve/tournament_file.h>
#include <folk/tools/program/number_text.h>

#include <fmt/format.h>
#include <folk/analysis/evolution/score_table.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace folk::tools {
namespace {

using Json = nlohmann::json;

/// A member that must be there and of a kind.
const Json& member_of(const Json& object, const char* name, bool (Json::*kind)() const noexcept,
                      const std::string& file) {
  const auto found = object.find(name);
  if (found == object.end() || !((*found).*kind)())
    refuse_file(file, fmt::format("no \"{}\" as ipd-tournament --format json writes it", name));
  return *found;
}

/// The rows of a square matrix of numbers.
std::vector<std::vector<double>> matrix_of(const Json& object, const char* name, std::size_t size,
                                           const std::string& file) {
  std::vector<std::vector<double>> rows;
  for (const auto& row : member_of(object, name, &Json::is_array, file)) {
    auto& numbers = rows.emplace_back();
    if (row.is_array())
      for (const auto& cell : row) {
        if (!cell.is_number() || !std::isfinite(cell.get<double>()))
          refuse_file(file, fmt::format("\"{}\" holds a {}: expected numbers, of a tournament with self-play", name,
                                        cell.is_number() ? "number too large" : cell.type_name()));
        numbers.push_back(cell.get<double>());
      }
    if (numbers.size() != size) rows.clear();
  }
  if (rows.size() != size) refuse_file(file, fmt::format("\"{}\": expected {} rows of {} numbers", name, size, size));
  return rows;
}

Rational weight_of(const Criterion& criterion) {
  if (criterion.is_finite()) return criterion.rounds();
  if (criterion.kind() != Criterion::Kind::ending) return 1;
  return Rational(1) / (Rational(1) - criterion.exact_continuation());
}

/// True where some figure is not exact. Throws InputFileError where some are no limits.
bool rounded(const Json& object, const Criterion& criterion, const std::string& file) {
  bool found = !criterion.is_finite();
  const auto rows = object.find("method_rows");
  if (rows == object.end() || !rows->is_array()) return found;
  for (const auto& row : *rows) {
    const auto letters = row.is_string() ? row.get<std::string>() : std::string();
    if (letters.find('b') != std::string::npos)
      refuse_file(file, "some scores are \"bounded\": no limit is proved; play with a horizon (--rounds N)");
    found = found || letters.find_first_of("ms") != std::string::npos;
  }
  return found;
}

PlayedScores from_json(const std::string& text, const std::string& file) {
  Json object;
  try {
    object = Json::parse(text);
  } catch (const Json::exception& error) {
    refuse_file(file, fmt::format("not well-formed JSON: {}", excerpt(error.what(), 120)));
  }
  std::vector<std::string> names;
  for (const auto& name : member_of(object, "strategies", &Json::is_array, file)) {
    if (!name.is_string()) refuse_file(file, "\"strategies\": expected names");
    names.push_back(name.get<std::string>());
  }
  if (names.size() > most_in_table)
    refuse_file(file, fmt::format("{} strategies: expected at most {}", names.size(), most_in_table));
  const auto scores = matrix_of(object, "scores", names.size(), file);
  std::vector<double> cooperations;
  if (object.contains("cooperations"))
    for (const auto& row : matrix_of(object, "cooperations", names.size(), file))
      cooperations.insert(cooperations.end(), row.begin(), row.end());
  PlayedScores found;
  try {
    const auto criterion = Criterion::parse(member_of(object, "criterion", &Json::is_string, file).get<std::string>());
    std::vector<std::vector<Rational>> exact;
    for (const auto& row : scores) {
      auto& numbers = exact.emplace_back();
      for (const double score : row) numbers.push_back(as_written(score));
    }
    found.scores = std::make_shared<ScoreMatrix>(std::move(names), exact, weight_of(criterion), std::move(cooperations),
                                                 rounded(object, criterion, file));
    found.line = fmt::format("scores of {}: {}", file, criterion.to_string());
    found.members = {{"tournament", json_string(file)}, {"criterion", json_string(criterion.to_string())}};
  } catch (const UsageError& error) {
    refuse_file(file, error.what());
  }
  found.roster = file;
  return found;
}

}  // namespace

PlayedScores read_tournament_file(const std::string& file) {
  if (file.empty()) throw UsageError("--tournament '': expected the name of a file");
  const std::string text = read_text_file(file);
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') return from_json(text, file);
  auto table = read_score_table(text, file);
  PlayedScores found;
  try {
    found.scores = std::make_shared<ScoreMatrix>(std::move(table.names), table.rows, 1);
  } catch (const UsageError& error) {
    refuse_file(file, error.what());
  }
  found.roster = file;
  found.line = fmt::format("scores of {}, taken as payoffs", file);
  found.members = {{"tournament", json_string(file)}};
  return found;
}

}  // namespace folk::tools
