#pragma once
// Pictures by the programs that draw them: `dot` for automata, `gnuplot` for plots. Each is optional at run time.

#include <folk/games/error.h>

#include <filesystem>
#include <string>
#include <vector>

namespace folk {

/// The program that draws is not on PATH.
class RendererMissing : public EnvironmentError {
public:
  using EnvironmentError::EnvironmentError;
};

/// What `argv` (the program is looked up on PATH, no shell is involved) writes to its standard output with `input` on
/// its standard input. `package` is the Debian package that holds the program. Throws RendererMissing when the program
/// is not installed, EnvironmentError with the most telling line of its standard error when it fails.
std::string run_renderer(const std::vector<std::string>& argv, const std::string& input, const std::string& package);

/// The formats of pictures that both programs write.
enum class PictureFormat { svg, png, pdf };

/// "svg", "png" or "pdf".
std::string to_string(PictureFormat format);

/// Where dot puts the parts of a graph in the DOT language, in its plain format. Throws EnvironmentError, as
/// run_renderer does.
std::string plain_layout(const std::string& dot);

/// Lays out a graph in the DOT language, or takes the places that its text gives to nodes and edges, and writes it as a
/// picture. Throws EnvironmentError, as run_renderer does.
enum class Places { by_dot, given };
void render_dot(const std::string& dot, const std::filesystem::path& path, PictureFormat format,
                Places places = Places::by_dot);

}  // namespace folk
