#pragma once
// The study's pictures, by gnuplot.

#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>
#include <folk/mpe/study/study_tables.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace folk::mpe {

/// A place of a curve with its 95 % interval's half width.
struct CurvePoint {
  double x = 0;
  double y = 0;
  double ci95 = 0;
};

struct IntervalCurve {
  std::string name;
  std::size_t look = 0;  ///< which colour and sign
  std::vector<CurvePoint> points;
};

/// Curves with intervals.
struct IntervalCurvesPlot {
  std::string title, x_title, y_title;
  std::vector<IntervalCurve> curves;
  Caption caption{};
};

/// Numbers of ours over those of the paper, a colour and sign a learner, and the diagonal on which they are equal. The
/// frame holds all points; intervals may reach beyond it.
struct AgreementPlot {
  struct Point {
    double paper = 0;
    double paper_ci95 = 0;
    double ours = 0;
    double ci95 = 0;
  };
  struct Learner {
    std::string name;
    std::size_t look = 0;  ///< which colour and sign
    std::vector<Point> points;
  };
  std::string title;
  std::vector<Learner> learners;
  Caption caption{};
};

/// Shares as bars in groups, with intervals as far as a share can be, each with a line at the share that it is held
/// against.
struct ShareBarsPlot {
  struct Bar {
    std::optional<Cell> cell;
    std::optional<double> mark;
  };
  struct Kind {
    std::string name;
    std::size_t look = 0;   ///< which colour
    std::vector<Bar> bars;  ///< one a group
  };
  std::string title, y_title, mark_title;
  std::vector<std::string> groups;
  std::vector<Kind> kinds;
  Caption caption{};
};

/// The whole gnuplot scripts, data included, that draw into `output`. Throw UsageError when there is nothing to draw or
/// a number is not finite.
std::string interval_curves_script(const IntervalCurvesPlot& plot, PictureFormat format);
std::string agreement_script(const AgreementPlot& plot, PictureFormat format);
std::string share_bars_script(const ShareBarsPlot& plot, PictureFormat format);

/// A picture of the study.
struct StudyPicture {
  std::string name;   ///< of its file: "blend_simple_tag"
  std::string words;  ///< for who cannot see it
  std::function<std::string(PictureFormat)> script;
};

/// Those for which anything was run, a scenario each: scores_ (ours over the paper's), blend_, accuracy_ and asked_ of
/// the level expert.
std::vector<StudyPicture> study_pictures(const StudyTables& tables);

/// The names of all that study_pictures could return.
std::vector<std::string> study_picture_names(const StudyTables& tables);

/// Draws to a file whose extension is .svg, .png or .pdf. Throws as gnuplot::draw_script does.
void draw(const StudyPicture& picture, const std::filesystem::path& path);

}  // namespace folk::mpe
