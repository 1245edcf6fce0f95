#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/render.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/pictures/draw_episode.h>
#include <folk/mpe/pictures/episode_animation.h>
#include <folk/mpe/pictures/filmstrip.h>
#include <folk/mpe/pictures/gnuplot_shapes.h>

#include <fmt/format.h>

namespace folk::mpe {
namespace {

namespace fs = std::filesystem;

PictureFormat episode_format(const fs::path& path) {
  if (path.extension() == ".svg") return PictureFormat::svg;
  if (path.extension() == ".png") return PictureFormat::png;
  if (path.extension() == ".pdf") return PictureFormat::pdf;
  throw UsageError(fmt::format("{}: a picture of an episode ends in .svg (animated), .png or .pdf (a filmstrip)",
                               excerpt(path.string(), 200)));
}

}  // namespace

void require_drawable(const fs::path& path) {
  if (episode_format(path) != PictureFormat::svg) gnuplot::require_gnuplot();
  require_writable(path);
}

void draw_episode(const EpisodeRecord& record, const fs::path& path) {
  if (episode_format(path) == PictureFormat::svg) return write_file(path, animated_svg(record));
  const Picture picture = draw_filmstrip(record);
  gnuplot::draw_script(path, picture.title, [&](PictureFormat format) { return gnuplot_script(picture, format); });
}

}  // namespace folk::mpe
