#include <folk/games/utf8.h>
#include <folk/tools/program/html.h>

#include <algorithm>
#include <string>

namespace folk::tools {
namespace {

/// What has no place in a page: a blank for what is not drawn (line ends are), U+FFFD for what is no UTF-8.
std::string well_formed(std::string_view text) {
  std::string kept;
  for (const std::string_view character : utf8_characters(text))
    kept += no_character(character) ? "\xEF\xBF\xBD" : undrawn(character) && character != "\n" ? " " : character;
  return kept;
}

}  // namespace

Html::Html(std::string_view text) {
  for (const char c : well_formed(text)) {
    switch (c) {
      case '&': markup_ += "&amp;"; break;
      case '<': markup_ += "&lt;"; break;
      case '>': markup_ += "&gt;"; break;
      case '"': markup_ += "&quot;"; break;
      case '\'': markup_ += "&#39;"; break;
      default: markup_ += c;
    }
  }
}

Html Html::markup(std::string markup) {
  Html html;
  html.markup_ = std::move(markup);
  return html;
}

Html element(const std::string& name, const Html& content,
             const std::vector<std::pair<std::string, std::string>>& attributes) {
  std::string open = "<" + name;
  for (const auto& [attribute, value] : attributes) open += " " + attribute + "=\"" + Html(value).string() + "\"";
  return Html::markup(open + ">" + content.string() + "</" + name + ">");
}

Html element_of(const std::string& name, const std::string& css_class, const Html& content) {
  return element(name, content, {{"class", css_class}});
}

Html heading(int level, const Html& content) { return element("h" + std::to_string(level), content) + "\n"; }

Html paragraph(const Html& content) { return element("p", content) + "\n"; }

Html link(const std::string& id, const Html& content) { return element("a", content, {{"href", "#" + id}}); }

Html HtmlTable::cell(const std::string& name, std::size_t column, const Html& content) const {
  std::vector<std::pair<std::string, std::string>> attributes;
  if (column < css_class_.size() && !css_class_[column].empty()) attributes.emplace_back("class", css_class_[column]);
  if (name == "td" && stacks() && column > 0) attributes.emplace_back("data-heading", headings_[column]);
  return element(name, content, attributes);
}

bool HtmlTable::stacks() const { return std::find(css_class_.begin(), css_class_.end(), "long") != css_class_.end(); }

void HtmlTable::add(const std::vector<Html>& cells) {
  Html row;
  for (std::size_t i = 0; i < cells.size(); ++i) row += cell("td", i, cells[i]);
  rows_ += element("tr", row) + "\n";
}

Html HtmlTable::html() const {
  Html head;
  for (std::size_t i = 0; i < headings_.size(); ++i) head += cell("th", i, headings_[i]);
  const Html table = element("thead", element("tr", head)) + "\n" + element("tbody", rows_);
  return element_of("div", stacks() ? "scroll stacks" : "scroll", element("table", table)) + "\n";
}

}  // namespace folk::tools
