#include <folk/strategies/names.h>
#include <folk/strategies/nearest_names.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace folk {
namespace {

/// How many letters must be inserted, dropped or changed (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j)
      diagonal = std::exchange(row[j + 1], std::min({row[j + 1] + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0U : 1U)}));
  }
  return row.back();
}

}  // namespace

std::vector<std::string> nearest_names(std::string_view name, const std::vector<NameCandidate>& candidates) {
  const std::string key = name_key(name.substr(0, 100));
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const auto& candidate : candidates) {
    const std::size_t distance = edit_distance(key, candidate.key);
    if (distance <= std::max<std::size_t>(2, key.size() / 2)) near.emplace_back(distance, candidate.shown);
  }
  std::sort(near.begin(), near.end());
  std::vector<std::string> names;
  for (const auto& [distance, shown] : near)
    if (names.size() < 3 && std::find(names.begin(), names.end(), shown) == names.end()) names.push_back(shown);
  return names;
}

}  // namespace folk
