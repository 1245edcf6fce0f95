#pragma once
// Shapes as SVG.

#include <folk/mpe/pictures/display_list.h>

#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// A number in as few digits as a picture needs: tenths.
std::string svg_number(double value);

/// Corners as the data of a path, "M1 2 3 4".
std::string svg_path_data(const std::vector<Point>& corners);

/// Any text as XML's character data or an attribute's value.
std::string xml_text(std::string_view text);

/// The elements that draw the shapes, one a line.
std::string svg_elements(const std::vector<Shape>& shapes);

/// A whole document, which refers to nothing outside it. `title` is what a screen reader says, `body` its elements.
std::string svg_document(double width, double height, std::string_view title, std::string_view body);

}  // namespace folk::mpe
