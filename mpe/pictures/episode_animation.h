#pragma once
// An episode that plays by itself in a browser.

#include <folk/mpe/evaluation/episode_record.h>

#include <string>

namespace folk::mpe {

/// One SVG document, animated by its own elements (SMIL): no script, nothing outside it. It plays four steps a second,
/// rests at the end and begins again. Where it is not played, the picture shows the last moment with all trails. An
/// episode of more than 120 steps is shown in 121 equally spaced moments. Throws UsageError as film_of does.
std::string animated_svg(const EpisodeRecord& record);

}  // namespace folk::mpe
