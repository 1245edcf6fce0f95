#pragma once
// What a picture of an episode says in words: its heading, its legend and its caption.

#include <folk/mpe/pictures/arena_drawing.h>

#include <vector>

namespace folk::mpe {

/// Pixels between the picture's edge and what is in it.
inline constexpr double margin = 16;

/// Title and subtitle at the picture's top left corner; below `heading_height` is room for the rest.
std::vector<Shape> draw_heading(const Film& film);
inline constexpr double heading_height = 64;

/// How wide a picture must be for its heading, an upper estimate.
double heading_width(const Film& film);

/// What was played and which Folk drew it, at the foot of a picture of this height; `caption_height` is its room.
std::vector<Shape> draw_caption(const Film& film, double bottom);
inline constexpr double caption_height = 22;

/// How wide a picture must be for its caption, an upper estimate.
double caption_width(const Film& film);

/// What each colour and sign means, in columns, as many as the width holds.
std::vector<Shape> draw_legend(const Film& film, const ArenaView& view, const Point& top_left, double width);
double legend_height(const Film& film, const ArenaView& view, double width);

}  // namespace folk::mpe
