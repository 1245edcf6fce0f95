#pragma once
// Shapes as a gnuplot script.

#include <folk/analysis/pictures/render.h>
#include <folk/mpe/pictures/display_list.h>

#include <filesystem>
#include <string>

namespace folk::mpe {

/// The whole script, data included, that draws a picture into `output`; no text in it is executed. Texts lie above all
/// else. Throws UsageError on a path with a control character.
std::string gnuplot_script(const Picture& picture, PictureFormat format);

}  // namespace folk::mpe
