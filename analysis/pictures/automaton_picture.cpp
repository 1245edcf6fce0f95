#include <folk/analysis/pictures/automaton_picture.h>
#include <folk/analysis/pictures/graph_layout.h>
#include <folk/analysis/pictures/label_placement.h>

namespace folk {

void draw_automaton(const Automaton& minimised, const DrawingOptions& options, const std::filesystem::path& path,
                    PictureFormat format) {
  constexpr double label_size = 12;  // as to_dot says, and an arrow's head of 0.8 times 10 points
  constexpr double head = 8;
  const std::string dot = to_dot(minimised, options);
  GraphLayout layout = read_plain(plain_layout(dot), head);
  place_labels(layout, label_size, head);
  render_dot(with_places(dot, layout, label_size), path, format, Places::given);
}

}  // namespace folk
