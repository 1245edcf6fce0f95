#pragma once
// An episode as a strip of frames.

#include <folk/mpe/evaluation/episode_record.h>
#include <folk/mpe/pictures/display_list.h>

#include <cstddef>
#include <string>

namespace folk::mpe {

/// The largest number of frames of a strip.
inline constexpr std::size_t most_strip_frames = 60;

/// So many equally spaced steps side by side, the first and the last included, six in a row; fewer where the episode
/// has fewer. Each shows the trails and contacts up to then, and the return so far. Throws UsageError unless `frames`
/// is 2 to most_strip_frames, and as film_of does.
Picture draw_filmstrip(const EpisodeRecord& record, std::size_t frames = 6);

/// The same as an SVG document.
std::string filmstrip_svg(const EpisodeRecord& record, std::size_t frames = 6);

}  // namespace folk::mpe
