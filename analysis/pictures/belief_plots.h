#pragma once
// The pictures of a policy's beliefs: against the truth round by round, their accuracy, their calibration; by gnuplot.

#include <folk/analysis/beliefs/belief_consistency.h>
#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// Later rounds of a match are not drawn: a picture has no room for them.
inline constexpr std::size_t most_drawn_rounds = 400;

/// What was believed in each round of a match, beside what the opponent then did.
struct BeliefPathPlot {
  BeliefMatch match;
  std::string title;
  Caption caption{};
};

/// In how many rounds the likelier move was played, opponent by opponent.
struct AccuracyPlot {
  std::vector<std::string> names;             ///< the first at the top
  std::vector<std::optional<double>> shares;  ///< 0 to 1; nothing where there was no belief
  std::string title;
  Caption caption{};
};

/// A reliability diagram (Murphy & Winkler 1977): how often C was played when it was believed in so much.
struct CalibrationPlot {
  std::array<CalibrationBin, 10> bins;
  std::string title;
  Caption caption{};
};

/// The whole gnuplot script, data included, that draws into `output` (any path; nothing in a name or a path is
/// executed). Throws UsageError on a match without rounds, on no names or more than most_plotted (plots.h), on names
/// and shares of different numbers, on a probability outside [0, 1], and on a path with a control character.
std::string belief_path_script(const BeliefPathPlot& plot, PictureFormat format);
std::string accuracy_script(const AccuracyPlot& plot, PictureFormat format);
std::string calibration_script(const CalibrationPlot& plot, PictureFormat format);

/// Draws to a file whose extension is .svg, .png or .pdf; a failure leaves no half picture.
/// Throws UsageError as above and on another extension, RendererMissing without gnuplot, EnvironmentError when it fails
/// or the file cannot be written.
void draw(const BeliefPathPlot& plot, const std::filesystem::path& path);
void draw(const AccuracyPlot& plot, const std::filesystem::path& path);
void draw(const CalibrationPlot& plot, const std::filesystem::path& path);

}  // namespace folk
