#pragma once
// HTML that cannot be broken by what it says: text is escaped on its way in, only this file makes markup.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace folk::tools {

/// A piece of a page. What is made from text holds that text and no markup.
class Html {
public:
  Html() = default;
  Html(std::string_view text);  // NOLINT: text becomes harmless wherever a piece of a page is asked for
  Html(const std::string& text)
      : Html(std::string_view(text)) {}
  Html(const char* text)
      : Html(std::string_view(text)) {}

  /// Of markup that holds nobody's words but the program's own.
  static Html markup(std::string markup);

  Html& operator+=(const Html& more) {
    markup_ += more.markup_;
    return *this;
  }
  friend Html operator+(Html first, const Html& second) { return first += second; }

  bool empty() const { return markup_.empty(); }
  const std::string& string() const { return markup_; }

private:
  std::string markup_;
};

/// <name name-of-attribute="value" ...>content</name>; the values are escaped.
Html element(const std::string& name, const Html& content,
             const std::vector<std::pair<std::string, std::string>>& attributes = {});

/// The same of a class.
Html element_of(const std::string& name, const std::string& css_class, const Html& content);

/// A heading of level 1 to 6, and a paragraph; each ends its line.
Html heading(int level, const Html& content);
Html paragraph(const Html& content);

/// A link to the element of this id in the same page.
Html link(const std::string& id, const Html& content);

/// A table with a row of headings that scrolls by itself where it is wider than the page. One with a column of the
/// class "long" is of the class "stacks": on a narrow page its cells may stand below each other, each with its heading.
class HtmlTable {
public:
  /// `css_class`: one class a column, or nothing.
  explicit HtmlTable(std::vector<std::string> headings, std::vector<std::string> css_class = {})
      : headings_(std::move(headings)),
        css_class_(std::move(css_class)) {}
  void add(const std::vector<Html>& cells);
  Html html() const;

private:
  Html cell(const std::string& name, std::size_t column, const Html& content) const;
  bool stacks() const;

  std::vector<std::string> headings_;
  std::vector<std::string> css_class_;
  Html rows_;
};

}  // namespace folk::tools
