#pragma once
// Pictures by the programs that draw them: `dot` for automata, `gnuplot` for plots. Each is optional at run time.

#include <folk/games/error.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace folk {

/// The program that draws is not on PATH.
class RendererMissing : public EnvironmentError {
public:
  using EnvironmentError::EnvironmentError;
};

/// Runs `argv` (the program is looked up on PATH, no shell is involved) with `input` on its standard input and waits.
/// Its standard output is dropped. `package` is the Debian package that holds the program.
/// Throws RendererMissing when the program is not installed, EnvironmentError with the most telling line of its
/// standard error when it fails.
void run_renderer(const std::vector<std::string>& argv, const std::string& input, const std::string& package);

/// Has `draw` write a picture to a temporary name beside `path` and renames it, so that a failure leaves no half file.
/// Throws EnvironmentError when the folder does not exist or cannot be written, and whatever `draw` throws.
void draw_file(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& draw);

/// The formats of pictures that both programs write.
enum class PictureFormat { svg, png, pdf };

/// "svg", "png" or "pdf".
std::string to_string(PictureFormat format);

/// Lays out a graph in the DOT language and writes it as a picture. Throws EnvironmentError, as run_renderer does.
void render_dot(const std::string& dot, const std::filesystem::path& path, PictureFormat format);

}  // namespace folk
