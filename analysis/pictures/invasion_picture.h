#pragma once
// Who can invade whom, drawn to a file.

#include <folk/analysis/evolution/invasion.h>
#include <folk/analysis/pictures/caption.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace folk {

/// Of more strategies than this a matrix is drawn: the graph's arrows could not be followed.
inline constexpr std::size_t most_in_graph = 16;

/// Throws what draw_invasions would before it draws: UsageError on more than most_plotted strategies (plots.h),
/// RendererMissing without dot (a graph) or gnuplot (a matrix).
void require_invasion_picture(std::size_t strategies);

/// Draws the graph of invasion_drawing.h or the matrix of invasion_matrix.h to a file whose extension is .svg, .png or
/// .pdf. Throws as require_invasion_picture, UsageError on another extension, EnvironmentError when the drawing program
/// fails or the file cannot be written.
void draw_invasions(const Invasions& invasions, const std::vector<std::string>& names, const std::string& title,
                    const Caption& caption, const std::filesystem::path& path);

}  // namespace folk
