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

/// At most `most` characters, the middle of a longer text left out.
std::string shortened(std::string_view text, std::size_t most) {
  auto parts = characters(text);
  if (parts.size() > most) {
    const auto head = static_cast<std::ptrdiff_t>(most / 2);
    const auto tail = static_cast<std::ptrdiff_t>(most - most / 2 - 1);
    parts.erase(parts.begin() + head, parts.end() - tail);
    parts.insert(parts.begin() + head, "…");
  }
  return join(parts);
}

/// An upper estimate for DejaVu Sans, the widest of the usual fonts.
double text_width(std::size_t characters, double font) { return 0.63 * font * static_cast<double>(characters); }

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

constexpr const char* package = "gnuplot-nox";

/// gnuplot ends well on a full disk too: what it wrote must have the end that its format has.
void require_whole(std::string_view picture, PictureFormat format, const fs::path& path) {
  constexpr std::size_t longest_tail = 32;
  const std::string_view end = format == PictureFormat::svg   ? "</svg>"
                               : format == PictureFormat::png ? "IEND"
                                                              : "%%EOF";
  if (picture.substr(picture.size() - std::min(picture.size(), longest_tail)).find(end) == std::string_view::npos)
    throw EnvironmentError(fmt::format("{}: gnuplot did not write it to its end: is the disk full?", path.string()));
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

std::string name_literal(std::string_view name) { return text_literal(shortened(name, longest_name)); }

double title_width(std::string_view title) { return text_width(characters(title).size(), title_font); }

double widest_name(const std::vector<std::string>& names, double font) {
  std::size_t most = 0;
  for (const auto& name : names) most = std::max(most, std::min(characters(name).size(), longest_name));
  return text_width(most, font);
}

double row_height(std::size_t names) { return names <= 60 ? 22 : names <= 120 ? 14 : 10; }

std::string Layout::x(double pixels) const { return fmt::format("screen {:.6f}", pixels / width); }

std::string Layout::y(double pixels) const { return fmt::format("screen {:.6f}", 1 - pixels / height); }

std::string opening(PictureFormat format, const Layout& layout, std::string_view title) {
  std::string text = "set encoding utf8\n" + terminal(format, layout.width, layout.height);
  text += fmt::format("set lmargin at {}\nset rmargin at {}\nset tmargin at {}\nset bmargin at {}\n",
                      layout.x(layout.left), layout.x(layout.right), layout.y(layout.top), layout.y(layout.bottom));
  text += fmt::format("set label {} at {},{} left font ',{}' front\n", text_literal(title), layout.x(14), layout.y(22),
                      title_font);
  return text + "unset key\n";
}

std::string name_tics(std::string_view axis, const std::vector<std::string>& names, double font,
                      std::string_view options) {
  std::string text = fmt::format("set {} (", axis);
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", tic_literal(shortened(names[i], longest_name)), i);
  return text + fmt::format(") scale 0 font ',{}' textcolor rgb 'black' {}\n", font, options);
}

PictureFormat picture_format(const fs::path& path) {
  const std::string extension = path.extension().string();
  for (const auto format : {PictureFormat::svg, PictureFormat::png, PictureFormat::pdf})
    if (extension == fmt::format(".{}", to_string(format))) return format;
  throw UsageError(fmt::format("{}: a plot's file name ends in .svg, .png or .pdf", path.string()));
}

void require_gnuplot() { run_renderer({"gnuplot", "--version"}, "", package); }

void draw_script(const fs::path& path, const std::function<std::string(PictureFormat)>& script) {
  const PictureFormat format = picture_format(path);
  require_writable(path);
  // -d: whatever a user's own .gnuplot sets, the picture is the same.
  const std::string picture = run_renderer({"gnuplot", "-d", "-"}, script(format), package);
  require_whole(picture, format, path);
  write_file(path, format == PictureFormat::svg ? mended_markup(picture) : picture);
}

}  // namespace folk::gnuplot
