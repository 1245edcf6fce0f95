#include <folk/mpe/pictures/return_curve.h>

#include <algorithm>

namespace folk::mpe {

ReturnCurve::ReturnCurve(const Film& film, Point top_left, double width, double height) {
  double low = 0;
  double high = 0;
  for (const auto& frame : film.frames) {
    low = std::min(low, frame.predators_return);
    high = std::max(high, frame.predators_return);
  }
  // A curve that is flat lies in the middle. Halves, for a return near the largest double.
  const double range = high / 2 - low / 2;
  const auto down = [&](double value) {
    return top_left.y + height * (range > 0 ? (high / 2 - value / 2) / range : 0.5);
  };
  const double steps = std::max(1.0, static_cast<double>(film.steps()));
  for (const auto& frame : film.frames)
    places_.push_back({top_left.x + width * static_cast<double>(frame.step) / steps, down(frame.predators_return)});
  zero_ = down(0);
}

Point ReturnCurve::place(std::size_t frame) const { return places_[frame]; }

std::vector<Shape> ReturnCurve::draw() const {
  return {Path{{{places_.front().x, zero_}, {places_.back().x, zero_}}, false, {}, Paint{"#bbbbbb"}, 1},
          Path{places_, false, {}, Paint{"#555555"}, 1.5}};
}

}  // namespace folk::mpe
