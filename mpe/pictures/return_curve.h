#pragma once
// The predators' return as it grows from step to step.

#include <folk/mpe/pictures/display_list.h>
#include <folk/mpe/pictures/film.h>

#include <cstddef>
#include <vector>

namespace folk::mpe {

/// A curve of the return so far over the steps, in a box of the picture.
class ReturnCurve {
public:
  ReturnCurve(const Film& film, Point top_left, double width, double height);

  /// Where the curve is at a frame.
  Point place(std::size_t frame) const;

  /// The line of return 0 and the curve.
  std::vector<Shape> draw() const;

private:
  std::vector<Point> places_;
  double zero_ = 0;  ///< how far down the picture the return is 0
};

}  // namespace folk::mpe
