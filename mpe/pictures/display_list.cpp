#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/games/utf8.h>
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

}  // namespace

Path rectangle(Point top_left, double width, double height) {
  const double right = top_left.x + width;
  const double bottom = top_left.y + height;
  return {{top_left, {right, top_left.y}, {right, bottom}, {top_left.x, bottom}}, true, {}, {}, 1};
}

std::string printable(std::string_view text, std::size_t most) {
  const std::string kept = kept_characters(text);
  const auto characters = utf8_characters(kept);
  if (characters.size() <= most) return kept;
  const std::size_t head = most / 2;
  const std::size_t tail = most - head - 1;
  std::string shown;
  for (std::size_t i = 0; i < head; ++i) shown += characters[i];
  shown += "…";
  for (std::size_t i = characters.size() - tail; i < characters.size(); ++i) shown += characters[i];
  return shown;
}

}  // namespace folk::mpe
