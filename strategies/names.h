#pragma once
// How names of strategies are matched, and lists of them taken apart.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// A name as it is matched: lower case, without blanks, '_' and '-'.
std::string name_key(std::string_view name);

/// Without the blanks and tabs around it.
std::string_view trimmed(std::string_view text);

/// Parts of a comma list; commas inside (), [] or double quotes do not split; blanks around parts are dropped.
/// Throws UsageError on an unclosed bracket or quote, and for brackets more than deepest_brackets deep.
std::vector<std::string> split_list(std::string_view text);

/// Rosters may stand in each other, and are read by functions that call each other as deep.
inline constexpr std::size_t deepest_brackets = 32;

/// "SPEC;LAST", what stands between the brackets of bayes, sample and half, at its last semicolon: earlier ones may
/// belong to SPEC, as in mem1(c;1,0,0,1). LAST is trimmed.
struct LastArgument {
  std::string_view spec;
  std::optional<std::string_view> last;
};
LastArgument split_last_argument(std::string_view arguments);

/// The trimmed text after "NAME=" where an argument is of that form, the name matched as names are (`name` is a
/// name_key); nothing for any other.
std::optional<std::string_view> value_of_option(std::string_view argument, std::string_view name);

/// True for what a user may call a strategy, in a machine file or by a label: at most longest_name letters, digits and
/// _ . - +, a letter or a digit first.
bool is_own_name(std::string_view name);

inline constexpr std::size_t longest_name = 100;
inline constexpr std::string_view own_name_characters = "letters, digits and _ . - +";
bool is_letter_or_digit(char c);
/// One of own_name_characters.
bool is_name_character(char c);

/// An item of a roster, "hard=random(0.2)": what its strategy is called there, and what it is.
struct LabelledItem {
  std::optional<std::string> label;
  std::string_view spec;
};

/// An item without a '=' has no label; nor has one in which '(', '[', '"', '@' or ':' comes first, where a '=' belongs
/// to what is named. Throws UsageError for a label that is no own name, and for a label of nothing.
LabelledItem split_label(std::string_view item);

/// What the names of two strategies share when they are the same: what a prefix hands on (exec:CMD, sct:FILE) letter by
/// letter, any other name as it is matched.
std::string name_identity(std::string_view name);

/// True when two strategies' names have the same identity.
bool same_name(std::string_view a, std::string_view b);

}  // namespace folk
