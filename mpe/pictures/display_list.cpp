#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/mpe/pictures/display_list.h>

namespace folk::mpe {
namespace {

/// The characters that gnuplot's literal keeps, without its quotes and the second of each quote inside.
std::string kept_characters(std::string_view text) {
  const std::string literal = gnuplot::text_literal(text);
  std::string kept;
  for (std::size_t i = 1; i + 1 < literal.size(); ++i) {
    kept += literal[i];
    if (literal[i] == '\'') ++i;
  }
  return kept;
}

/// Where each character of well-formed UTF-8 begins, and the end.
std::vector<std::size_t> character_begins(std::string_view text) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) begins.push_back(i);
  begins.push_back(text.size());
  return begins;
}

}  // namespace

Path rectangle(Point top_left, double width, double height) {
  const double right = top_left.x + width;
  const double bottom = top_left.y + height;
  return {{top_left, {right, top_left.y}, {right, bottom}, {top_left.x, bottom}}, true, {}, {}, 1};
}

std::string printable(std::string_view text, std::size_t most) {
  const std::string kept = kept_characters(text);
  const auto begins = character_begins(kept);
  const std::size_t count = begins.size() - 1;
  if (count <= most) return kept;
  const std::size_t head = most / 2;
  const std::size_t tail = most - head - 1;
  return kept.substr(0, begins[head]) + "…" + kept.substr(begins[count - tail]);
}

}  // namespace folk::mpe
