#include <folk/games/error.h>
#include <folk/mpe/pictures/captions.h>
#include <folk/mpe/pictures/filmstrip.h>
#include <folk/mpe/pictures/svg_shapes.h>

#include <fmt/format.h>

#include <algorithm>

namespace folk::mpe {
namespace {

constexpr double panel_width = 216;
constexpr double panel_height = 300;
constexpr double gap = 10;
constexpr double step_height = 26;
constexpr std::size_t panels_in_row = 6;

/// Trails are drawn through so many moments; what happens between two of a longer episode is not seen.
constexpr std::size_t most_moments = 601;

void add_panel(Picture& picture, const Film& film, const ArenaView& view, std::size_t frame) {
  picture.add(draw_frame(film, view, frame));
  picture.shapes.emplace_back(
      Text{{view.corner().x + view.width() / 2, view.corner().y + view.height() + 13},
           fmt::format("step {}: return {}", film.frames[frame].step, return_text(film.frames[frame].predators_return)),
           12,
           Text::Anchor::middle});
}

}  // namespace

Picture draw_filmstrip(const EpisodeRecord& record, std::size_t frames) {
  if (frames < 2 || frames > most_strip_frames)
    throw UsageError(fmt::format("a filmstrip of {} frames: ask for 2 to {}", frames, most_strip_frames));
  const Film film = film_of(record, most_moments);
  const ArenaView view(film, panel_width, panel_height);
  const auto shown = equally_spaced(film.frames.size(), frames);
  const auto columns = static_cast<double>(std::min(shown.size(), panels_in_row));
  const auto rows = static_cast<double>((shown.size() + panels_in_row - 1) / panels_in_row);

  Picture picture;
  picture.width = std::max(2 * margin + columns * view.width() + (columns - 1) * gap, heading_width(film));
  picture.width = std::max(picture.width, caption_width(film));
  const double legend_top = heading_height + rows * (view.height() + step_height) + 8;
  const double legend_width = picture.width - 2 * margin;
  picture.height = legend_top + legend_height(film, view, legend_width) + 4 + caption_height;

  Path paper = rectangle({0, 0}, picture.width, picture.height);
  paper.fill = Paint{"#ffffff"};
  picture.shapes.emplace_back(paper);
  picture.title = film.title;
  picture.add(draw_heading(film));
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Point corner{margin + static_cast<double>(i % panels_in_row) * (view.width() + gap),
                       heading_height + static_cast<double>(i / panels_in_row) * (view.height() + step_height)};
    add_panel(picture, film, view.moved_to(corner), shown[i]);
  }
  picture.add(draw_legend(film, view, {margin, legend_top}, legend_width));
  picture.add(draw_caption(film, picture.height));
  return picture;
}

std::string filmstrip_svg(const EpisodeRecord& record, std::size_t frames) {
  const Picture picture = draw_filmstrip(record, frames);
  return svg_document(picture.width, picture.height, picture.title, svg_elements(picture.shapes));
}

}  // namespace folk::mpe
