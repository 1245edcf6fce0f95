#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/invasion_drawing.h>
#include <folk/analysis/pictures/invasion_matrix.h>
#include <folk/analysis/pictures/invasion_picture.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/analysis/pictures/render.h>

namespace folk {

void require_invasion_picture(std::size_t strategies) {
  if (strategies > most_in_graph) return require_plotter(strategies);
  run_renderer({"dot", "-V"}, "", "graphviz");
}

void draw_invasions(const Invasions& invasions, const std::vector<std::string>& names, const std::string& title,
                    const Caption& caption, const std::filesystem::path& path) {
  const PictureFormat format = gnuplot::picture_format(path);
  if (invasions.size() <= most_in_graph) return render_dot(to_dot(invasions, names, title, caption), path, format);
  gnuplot::draw_script(path, title, [&](PictureFormat chosen) {
    return invasion_matrix_script(invasions, names, title, caption, chosen);
  });
}

}  // namespace folk
