#include <folk/analysis/pictures/font_coverage.h>
#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/games/utf8.h>

#include <fmt/format.h>

#include <algorithm>

namespace folk::gnuplot {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_name = 32;

/// True for U+FFFE and U+FFFF, which XML has no place for.
bool noncharacter(std::string_view character) { return character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF"; }

/// The characters of a text that are drawn; a blank stands for another, a question mark for what is no character.
std::vector<std::string_view> characters(std::string_view text) {
  auto found = utf8_characters(text);
  for (auto& character : found) {
    if (no_character(character) || noncharacter(character))
      character = "?";
    else if (undrawn(character))
      character = " ";
  }
  return found;
}

std::string join(const std::vector<std::string_view>& parts) { return fmt::format("{}", fmt::join(parts, "")); }

/// At most `most` of these characters (at least 1), an ellipsis for the middle of more.
std::vector<std::string_view> shortened(std::vector<std::string_view> parts, std::size_t most) {
  if (parts.size() > most) {
    const auto head = static_cast<std::ptrdiff_t>(most / 2);
    const auto tail = static_cast<std::ptrdiff_t>(most - most / 2 - 1);
    parts.erase(parts.begin() + head, parts.end() - tail);
    parts.insert(parts.begin() + head, "…");
  }
  return parts;
}

std::vector<std::string_view> name_characters(std::string_view name) {
  return shortened(characters(name), longest_name);
}

/// How wide a character is at most in DejaVu Sans, the widest of the usual fonts, or in what stands in for it where it
/// has no such character; in units of the font's size.
double character_width(std::string_view character) {
  if (character.size() == 1) {
    const char c = character[0];
    const auto is_one_of = [c](std::string_view set) { return set.find(c) != std::string_view::npos; };
    if (is_one_of("'ijlI ,./:;\\|f-")) return 0.37;
    if (is_one_of("()[]t!r\"")) return 0.46;
    if (is_one_of("@Wm%")) return 1.02;
    if (is_one_of("M#+<=>^~w&OQDGHNU")) return 0.87;
    return c >= 'A' && c <= 'Z' ? 0.7 : 0.64;
  }
  // Two bytes hold the alphabets of Europe and the Near East, four signs and emoji.
  return character.size() == 2 ? 1.2 : character.size() == 3 ? 1.1 : 1.4;
}

double width_of(const std::vector<std::string_view>& parts, double font) {
  double width = 0;
  for (const auto part : parts) width += character_width(part);
  return font * width;
}

std::string terminal(PictureFormat format, double width, double height) {
  switch (format) {
    case PictureFormat::svg:
      return fmt::format("set terminal svg size {:.0f},{:.0f} noenhanced font 'Arial,12' background rgb 'white'\n",
                         width, height);
    case PictureFormat::png:
      // Two pixels for one, for print; the font's points are 4/3 of a pixel.
      return fmt::format(
          "set terminal pngcairo size {:.0f},{:.0f} noenhanced font 'Sans,12' fontscale 1.5 linewidth 2 pointscale 2.6 "
          "background rgb 'white'\n",
          2 * width, 2 * height);
    case PictureFormat::pdf: break;
  }
  return fmt::format(
      "set terminal pdfcairo size {:.4f}in,{:.4f}in noenhanced font 'Sans,12' fontscale 0.5625 linewidth 1 "
      "background rgb 'white'\n",
      width / 96, height / 96);
}

/// From the picture's edge to its title and its caption.
constexpr double words_margin = 14;

constexpr double caption_row = 15;

/// A wider title loses its middle; an SVG's own has all of it.
constexpr double widest_title = 900;

/// The caption in lines that a picture of this width holds.
std::vector<std::string> lines_of_caption(const Layout& layout, const Caption& caption) {
  constexpr double letter = 0.6 * note_font;  // on average
  return caption_lines(caption, static_cast<std::size_t>(std::max(0.0, layout.width - 2 * words_margin) / letter));
}

constexpr const char* package = "gnuplot-nox";

/// gnuplot ends well on a full disk too: what it wrote must have the end that its format has.
void require_whole(std::string_view picture, PictureFormat format, const fs::path& path) {
  constexpr std::size_t longest_tail = 32;
  const std::string_view end = format == PictureFormat::svg   ? "</svg>"
                               : format == PictureFormat::png ? "IEND"
                                                              : "%%EOF";
  if (picture.substr(picture.size() - std::min(picture.size(), longest_tail)).find(end) == std::string_view::npos)
    throw EnvironmentError(
        fmt::format("{}: gnuplot did not write it to its end: is the disk full?", excerpt(path.string(), 1000)));
}

/// gnuplot calls every SVG by its own name.
std::string titled(std::string picture, std::string_view title) {
  constexpr std::string_view theirs = "<title>Gnuplot</title>";
  const auto at = picture.find(theirs);
  if (at != std::string::npos) picture.replace(at, theirs.size(), fmt::format("<title>{}</title>", xml_text(title)));
  return picture;
}

/// gnuplot writes a text's > as it is: after ]] it must be an entity, or the picture is no XML.
std::string mended_markup(std::string picture) {
  constexpr std::string_view broken = "]]>";
  if (picture.find("<![CDATA[") != std::string::npos) return picture;
  for (std::size_t at = 0; (at = picture.find(broken, at)) != std::string::npos;)
    picture.replace(at, broken.size(), "]]&gt;");
  return picture;
}

}  // namespace

std::string text_literal(std::string_view text) {
  std::string out = "'";
  if (text.starts_with("'")) out += ' ';  // gnuplot does not read two quotes right after the first
  for (const auto& character : characters(text)) out += character == "'" ? "''" : character;
  return out + "'";
}

std::string tic_literal(std::string_view text) {
  std::string doubled;
  for (const char c : text) doubled += c == '%' ? std::string("%%") : std::string(1, c);
  return text_literal(doubled);
}

std::string name_literal(std::string_view name) { return text_literal(join(name_characters(name))); }

double text_width(std::string_view text, double font) { return width_of(characters(text), font); }

double widest_name(const std::vector<std::string>& names, double font) {
  double widest = 0;
  for (const auto& name : names) widest = std::max(widest, width_of(name_characters(name), font));
  return widest;
}

std::string fitted(std::string_view text, double font, double pixels) {
  const auto all = characters(text);
  auto parts = all;
  for (std::size_t most = all.size(); most > 1 && width_of(parts, font) > pixels;) parts = shortened(all, --most);
  return join(parts);
}

double row_height(std::size_t names) { return names <= 60 ? 22 : names <= 120 ? 14 : 10; }

std::string Layout::x(double pixels) const { return fmt::format("screen {:.6f}", pixels / width); }

std::string Layout::y(double pixels) const { return fmt::format("screen {:.6f}", 1 - pixels / height); }

Layout with_words(Layout layout, std::string_view title, const Caption& caption) {
  layout.width = std::max(layout.width, std::min(text_width(title, title_font), widest_title) + 2 * words_margin);
  const auto lines = lines_of_caption(layout, caption);
  for (const auto& line : lines) layout.width = std::max(layout.width, text_width(line, note_font) + 2 * words_margin);
  layout.height += caption_row * static_cast<double>(lines.size()) + 6;
  return layout;
}

std::string opening(PictureFormat format, const Layout& layout, std::string_view title, const Caption& caption) {
  std::string text = opening(format, layout);
  text += fmt::format("set label {} at {},{} left font ',{}' front\n",
                      text_literal(fitted(title, title_font, layout.width - 2 * words_margin)), layout.x(words_margin),
                      layout.y(22), title_font);
  const auto lines = lines_of_caption(layout, caption);
  double y = layout.height - 10 - caption_row * static_cast<double>(lines.size() - 1);
  for (const auto& line : lines) {
    text += fmt::format("set label {} at {},{} left font ',{}' textcolor rgb '#666666'\n", text_literal(line),
                        layout.x(words_margin), layout.y(y), note_font);
    y += caption_row;
  }
  return text;
}

std::string opening(PictureFormat format, const Layout& layout) {
  std::string text = "set encoding utf8\n" + terminal(format, layout.width, layout.height);
  text += fmt::format("set lmargin at {}\nset rmargin at {}\nset tmargin at {}\nset bmargin at {}\n",
                      layout.x(layout.left), layout.x(layout.right), layout.y(layout.top), layout.y(layout.bottom));
  return text + "unset key\n";
}

std::string name_tics(std::string_view axis, const std::vector<std::string>& names, double font,
                      std::string_view options) {
  std::string text = fmt::format("set {} (", axis);
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", tic_literal(join(name_characters(names[i]))), i);
  return text + fmt::format(") scale 0 font ',{}' textcolor rgb 'black' {}\n", font, options);
}

PictureFormat picture_format(const fs::path& path) {
  const std::string extension = path.extension().string();
  for (const auto format : {PictureFormat::svg, PictureFormat::png, PictureFormat::pdf})
    if (extension == fmt::format(".{}", to_string(format))) return format;
  throw UsageError(fmt::format("{}: a plot's file name ends in .svg, .png or .pdf", excerpt(path.string(), 200)));
}

void require_gnuplot() { run_renderer({"gnuplot", "--version"}, "", package); }

void draw_script(const fs::path& path, std::string_view title,
                 const std::function<std::string(PictureFormat)>& script) {
  const PictureFormat format = picture_format(path);
  require_writable(path);
  // -d: whatever a user's own .gnuplot sets, the picture is the same.
  // What an SVG's fonts are is the viewer's.
  const std::string text = format == PictureFormat::svg ? script(format) : with_drawable_characters(script(format));
  const std::string picture = run_renderer({"gnuplot", "-d", "-"}, text, package);
  require_whole(picture, format, path);
  write_file(path, format == PictureFormat::svg ? titled(mended_markup(picture), title) : picture);
}

std::string xml_text(std::string_view text) {
  std::string out;
  for (const auto part : characters(text)) {
    if (part == "&")
      out += "&amp;";
    else if (part == "<")
      out += "&lt;";
    else if (part == ">")
      out += "&gt;";
    else if (part == "\"")
      out += "&quot;";
    else
      out += part;
  }
  return out;
}

}  // namespace folk::gnuplot
