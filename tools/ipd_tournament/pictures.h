#pragma once
// The pictures of a finished tournament.

#include <folk/tools/ipd_tournament/output.h>

#include <folk/analysis/evolution/invasion.h>
#include <folk/analysis/tournament/tournament.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace folk::tools {

/// How they are drawn.
struct PictureChoice {
  std::string extension = "svg";  ///< "svg", "png" or "pdf"
  std::optional<std::array<double, 2>>
      scale;  ///< payoffs a round of the lowest and highest colour; nothing: what was paid
};

/// Throws what the drawing would, before anything is played: UsageError on more strategies than can be drawn,
/// RendererMissing.
void require_pictures(std::size_t strategies, bool with_invasions);

/// payoffs, cooperation and scores, and invasion where invasions are not null.
void draw_pictures(const std::filesystem::path& folder, const Tournament& tournament, const TournamentLabels& labels,
                   const Invasions* invasions, const PictureChoice& choice);

}  // namespace folk::tools
