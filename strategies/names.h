#pragma once
// How names of strategies are matched, and lists of them taken apart.

#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// A name as it is matched: lower case, without '_' and '-'.
std::string name_key(std::string_view name);

/// Parts of a comma list; commas inside (), [] or double quotes do not split; blanks around parts are dropped.
/// Throws UsageError on an unclosed bracket or quote.
std::vector<std::string> split_list(std::string_view text);

/// What the names of two strategies share when they are the same: what a prefix hands on (exec:CMD, sct:FILE) letter by
/// letter, any other name as it is matched.
std::string name_identity(std::string_view name);

/// True when two strategies' names have the same identity.
bool same_name(std::string_view a, std::string_view b);

}  // namespace folk
