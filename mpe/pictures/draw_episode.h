#pragma once
// An episode drawn to a file.

#include <folk/mpe/evaluation/episode_record.h>

#include <filesystem>

namespace folk::mpe {

/// Throws what draw_episode would throw before it draws, so that it shows before an episode is played and not after.
void require_drawable(const std::filesystem::path& path);

/// Draws the animated picture to a file that ends in .svg, the filmstrip to one that ends in .png or .pdf; a failure
/// leaves no half picture. Throws UsageError on another extension and as film_of does, RendererMissing without gnuplot,
/// which draws filmstrips,
/// EnvironmentError when gnuplot fails or the file cannot be written.
void draw_episode(const EpisodeRecord& record, const std::filesystem::path& path);

}  // namespace folk::mpe
