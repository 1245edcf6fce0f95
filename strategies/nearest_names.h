#pragma once
// What somebody may have meant who misspelt a name.

#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// A name as it is matched (name_key of names.h) and as it is shown.
struct NameCandidate {
  std::string key;
  std::string shown;
};

/// What is shown of the candidates nearest to `name` by letters inserted, dropped or changed (Levenshtein), at most
/// three, nearest first; none where all are far.
std::vector<std::string> nearest_names(std::string_view name, const std::vector<NameCandidate>& candidates);

}  // namespace folk
