#pragma once
// The numbers beside an animated episode: the step, the return so far, and the return's curve.

#include <folk/mpe/pictures/animation_clock.h>
#include <folk/mpe/pictures/film.h>

#include <string>

namespace folk::mpe {

inline constexpr double counters_height = 206;

/// As SVG elements, in a box of that height and this width.
std::string animated_counters(const Film& film, const AnimationClock& clock, const Point& top_left, double width);

}  // namespace folk::mpe
