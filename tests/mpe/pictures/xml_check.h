#pragma once
// Whether a text is a well-formed XML document of the simple kind that Folk writes: one root, elements and attributes
// in double quotes, the five entities, no comments.

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace folk::test {

class XmlCheck {
public:
  /// Empty when the document is well-formed, otherwise what is wrong and where.
  static std::string fault(std::string_view document) { return XmlCheck(document).run(); }

private:
  explicit XmlCheck(std::string_view document)
      : rest_(document),
        size_(document.size()) {}

  std::string run() {
    bool root_closed = false;
    while (!rest_.empty()) {
      const auto at = std::to_string(size_ - rest_.size());
      if (rest_.front() != '<') {
        const std::string_view text = take(rest_.find('<'));
        if (open_.empty() && text.find_first_not_of(" \n") != std::string_view::npos) return "text outside at " + at;
        if (!is_text(text)) return "bad text at " + at;
        continue;
      }
      if (root_closed) return "a second root at " + at;
      const auto end = rest_.find('>');
      if (end == std::string_view::npos) return "open tag at " + at;
      if (!tag(take(end + 1))) return "bad tag at " + at;
      root_closed = open_.empty();
    }
    return root_closed ? "" : "not closed";
  }

  std::string_view take(std::size_t length) {
    const std::string_view taken = rest_.substr(0, length);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  static bool is_text(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '<' || c == '>' || (static_cast<unsigned char>(c) < ' ' && c != '\n')) return false;
      if (c != '&') continue;
      constexpr std::array<std::string_view, 5> entities{"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"};
      if (std::none_of(entities.begin(), entities.end(),
                       [&](std::string_view entity) { return text.substr(i).starts_with(entity); }))
        return false;
    }
    return is_utf8(text);
  }

  static bool is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const auto first = static_cast<unsigned char>(text[i]);
      const std::size_t more = first < 0x80 ? 0 : first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC2 ? 1 : 9;
      if (i + more >= text.size()) return false;
      for (std::size_t k = 0; k < more; ++k)
        if ((static_cast<unsigned char>(text[++i]) & 0xC0U) != 0x80U) return false;
    }
    return true;
  }

  bool tag(std::string_view tag) {
    if (tag.starts_with("</")) {
      if (open_.empty() || tag != "</" + open_.back() + ">") return false;
      open_.pop_back();
      return true;
    }
    const bool empty = tag.ends_with("/>");
    tag = tag.substr(1, tag.size() - (empty ? 3 : 2));
    const std::string_view name = tag.substr(0, tag.find(' '));
    if (name.empty() || !std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalpha(c); }))
      return false;
    if (!empty) open_.emplace_back(name);
    return attributes(tag.substr(name.size()));
  }

  static bool attributes(std::string_view text) {
    std::set<std::string_view> names;
    while (!text.empty()) {
      const auto equals = text.find("=\"");
      if (text.front() != ' ' || equals == std::string_view::npos) return false;
      const auto close = text.find('"', equals + 2);
      if (close == std::string_view::npos || !is_text(text.substr(equals + 2, close - equals - 2))) return false;
      if (!names.insert(text.substr(1, equals - 1)).second) return false;
      text.remove_prefix(close + 1);
    }
    return true;
  }

  std::string_view rest_;
  std::size_t size_;
  std::vector<std::string> open_;
};

}  // namespace folk::test
