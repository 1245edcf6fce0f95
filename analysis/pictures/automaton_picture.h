#pragma once
// An automaton drawn to a file: laid out by dot, its labels where they can be read.

#include <folk/analysis/pictures/drawing.h>
#include <folk/analysis/pictures/render.h>

#include <filesystem>

namespace folk {

/// Draws what to_dot says, each label on its edge, on white and above all lines. Throws EnvironmentError, as
/// run_renderer does.
void draw_automaton(const Automaton& minimised, const DrawingOptions& options, const std::filesystem::path& path,
                    PictureFormat format);

}  // namespace folk
