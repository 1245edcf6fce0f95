#pragma once
// The picture of how agents learned: mean return over the episodes played, a line a run.

#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>

#include <filesystem>
#include <string>
#include <vector>

namespace folk::mpe {

/// A run's evaluations, in their order.
struct LearningCurve {
  std::string name;  ///< for the legend: "seed 1"
  std::vector<double> episodes;
  std::vector<double> returns;  ///< as many
};

/// A return that the curves are held against, drawn as a dashed line.
struct CurveMark {
  std::string name;
  double value = 0;
};

struct LearningCurvePlot {
  std::string title;
  std::string unit = "return of one predator";
  std::vector<LearningCurve> curves;
  std::vector<CurveMark> marks;
  Caption caption{};
};

/// The whole gnuplot script, data included, that draws into `output`. Throws UsageError on no curves, or one that is
/// empty, of two lengths, or not finite.
std::string learning_curve_script(const LearningCurvePlot& plot, PictureFormat format);

/// Draws to a file whose extension is .svg, .png or .pdf. Throws as learning_curve_script and gnuplot::draw_script do.
void draw(const LearningCurvePlot& plot, const std::filesystem::path& path);

}  // namespace folk::mpe
