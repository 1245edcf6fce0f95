#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/names.h>

namespace folk {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::string name_key(std::string_view name) {
  std::string key;
  for (const char c : name) {
    if (c == '_' || c == '-') continue;
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

std::string name_identity(std::string_view name) {
  return name.find(':') != std::string_view::npos ? std::string(name) : name_key(name);
}

bool same_name(std::string_view a, std::string_view b) { return name_identity(a) == name_identity(b); }

}  // namespace folk
