#pragma once
// What all gnuplot scripts of Folk share: text that cannot be taken for code, and the layout of a picture.

#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace folk::gnuplot {

/// Any text as a string in single quotes, in which nothing but the quote itself is special. Control characters become
/// blanks, bytes that are no UTF-8 question marks.
std::string text_literal(std::string_view text);

/// The same for the label of a tic, which gnuplot also reads as a format.
std::string tic_literal(std::string_view text);

/// The same for a name in a legend: at most 32 characters, the middle of a longer one left out.
std::string name_literal(std::string_view name);

/// Sizes of letters in pixels.
inline constexpr double title_font = 15;
inline constexpr double text_font = 12;
inline constexpr double note_font = 11;

/// Upper estimates in pixels of how wide a text is drawn, in whatever usual font the viewer has. Names are drawn with
/// at most 32 characters.
double text_width(std::string_view text, double font);
double widest_name(const std::vector<std::string>& names, double font);

/// A text that is at most so many pixels wide, the middle of a wider one left out.
std::string fitted(std::string_view text, double font, double pixels);

/// Pixels a row, where each of so many names has one.
double row_height(std::size_t names);

/// A picture and the frame inside it, in pixels from the picture's top left corner.
struct Layout {
  double width = 0;
  double height = 0;
  double left = 0;
  double right = 0;
  double top = 0;
  double bottom = 0;

  /// A place as gnuplot's screen coordinate.
  std::string x(double pixels) const;
  std::string y(double pixels) const;
};

/// The layout with room for the words around it: as wide as the title (without its middle where that is very long) and
/// the caption need, and higher by the caption.
Layout with_words(Layout layout, std::string_view title, const Caption& caption);

/// The first lines of a script: encoding, terminal, margins, title, and the caption at the foot of a layout that
/// with_words made.
std::string opening(PictureFormat format, const Layout& layout, std::string_view title, const Caption& caption);

/// The same without words, for a picture that has its own.
std::string opening(PictureFormat format, const Layout& layout);

/// The names as the labels of an axis ("ytics") at 0, 1, 2...
std::string name_tics(std::string_view axis, const std::vector<std::string>& names, double font,
                      std::string_view options);

/// The format that a picture's file name asks for. Throws UsageError unless it ends in .svg, .png or .pdf.
PictureFormat picture_format(const std::filesystem::path& path);

/// Throws RendererMissing where gnuplot is not installed.
void require_gnuplot();

/// Has gnuplot draw what `script` says to a file; a failure leaves no half picture. `title` is what an SVG is called,
/// which screen readers and browsers say. Throws UsageError as picture_format, RendererMissing without gnuplot,
/// EnvironmentError when it fails or the file cannot be written.
void draw_script(const std::filesystem::path& path, std::string_view title,
                 const std::function<std::string(PictureFormat)>& script);

/// Any text as XML's character data or an attribute's value, with what text_literal keeps of it.
std::string xml_text(std::string_view text);

}  // namespace folk::gnuplot
