#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/names.h>

#include <algorithm>

namespace folk {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

LastArgument split_last_argument(std::string_view arguments) {
  const auto semicolon = arguments.rfind(';');
  if (semicolon == std::string_view::npos) return {arguments, std::nullopt};
  return {arguments.substr(0, semicolon), trimmed(arguments.substr(semicolon + 1))};
}

std::optional<std::string_view> value_of_option(std::string_view argument, std::string_view name) {
  const auto equals = argument.find('=');
  if (equals == std::string_view::npos || name_key(argument.substr(0, equals)) != name) return std::nullopt;
  return trimmed(argument.substr(equals + 1));
}

std::string name_key(std::string_view name) {
  std::string key;
  for (const char c : name) {
    if (c == '_' || c == '-' || c == ' ' || c == '\t') continue;
    key += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return key;
}

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> parts;
  std::string closers;  // of the brackets that are open
  bool quoted = false;
  std::size_t begin = 0;
  const auto take = [&](std::size_t end) {
    const auto part = trimmed(text.substr(begin, end - begin));
    if (!part.empty()) parts.emplace_back(part);
    begin = end + 1;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '(' || c == '[') {
      closers += c == '(' ? ')' : ']';
      if (closers.size() > deepest_brackets)
        throw UsageError(
            fmt::format("'{}': brackets stand in each other more than {} deep", excerpt(text), deepest_brackets));
    } else if (!closers.empty() && c == closers.back()) {
      closers.pop_back();
    } else if (c == ',' && closers.empty()) {
      take(i);
    }
  }
  if (quoted || !closers.empty())
    throw UsageError(fmt::format("'{}': a {} is not closed", excerpt(text), quoted ? "quote" : "bracket"));
  take(text.size());
  return parts;
}

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

bool is_name_character(char c) { return is_letter_or_digit(c) || c == '_' || c == '.' || c == '-' || c == '+'; }

bool is_own_name(std::string_view name) {
  return !name.empty() && name.size() <= longest_name && is_letter_or_digit(name.front()) &&
         std::all_of(name.begin(), name.end(), is_name_character);
}

LabelledItem split_label(std::string_view item) {
  const auto sign = item.find_first_of("=([\"@:");
  if (sign == std::string_view::npos || item[sign] != '=') return {std::nullopt, item};
  const std::string_view label = trimmed(item.substr(0, sign));
  const std::string_view spec = trimmed(item.substr(sign + 1));
  if (!is_own_name(label))
    throw UsageError(fmt::format("'{}': '{}' is no label; use at most {} {}, a letter or a digit first", excerpt(item),
                                 excerpt(label), longest_name, own_name_characters));
  if (spec.empty())
    throw UsageError(
        fmt::format("'{}': the label names nothing; write LABEL=NAME, as in hard=random(0.2)", excerpt(item)));
  return {std::string(label), spec};
}

std::string name_identity(std::string_view name) {
  return name.find(':') != std::string_view::npos ? std::string(name) : name_key(name);
}

bool same_name(std::string_view a, std::string_view b) { return name_identity(a) == name_identity(b); }

}  // namespace folk
