#include <folk/mpe/pictures/counters.h>
#include <folk/mpe/pictures/return_curve.h>
#include <folk/mpe/pictures/svg_shapes.h>

#include <fmt/format.h>

#include <functional>
#include <vector>

namespace folk::mpe {
namespace {

using Travel = AnimationClock::Travel;

/// A number that changes from frame to frame: all of them below one another, moved behind a window that shows one.
std::string counter(const AnimationClock& clock, const Point& top_left, double width,
                    const std::function<std::string(std::size_t)>& number) {
  constexpr double letters = 26;
  constexpr double line = 34;
  std::string column;
  for (std::size_t i = 0; i <= clock.last(); ++i)
    column += fmt::format("<text y=\"{}\">{}</text>\n", svg_number(line * static_cast<double>(i) + letters), number(i));
  const auto place = [&](std::size_t frame) {
    return Point{top_left.x, top_left.y - line * static_cast<double>(frame)};
  };
  // The name says all of the window, so that two pictures in one page may share it.
  const std::string window = fmt::format("window-{}-{}", svg_number(top_left.x), svg_number(top_left.y));
  return fmt::format(
      "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n"
      "<g class=\"counter\" clip-path=\"url(#{0})\" font-size=\"{5}\" fill=\"#222222\">{6}</g>\n",
      window, svg_number(top_left.x), svg_number(top_left.y), svg_number(width), line, letters,
      clock.moved(place, Travel::jumps, column));
}

}  // namespace

std::string animated_counters(const Film& film, const AnimationClock& clock, const Point& top_left, double width) {
  const auto below = [&](double pixels) { return Point{top_left.x, top_left.y + pixels}; };
  const ReturnCurve curve(film, {top_left.x + 3, top_left.y + 114}, width - 6, 70);
  const Circle dot{{}, 3.5, Paint{"#222222"}, {}, 1};
  return svg_elements({Text{below(8), fmt::format("step (of {})", film.steps())}, Text{below(64), "return so far"}}) +
         counter(clock, below(16), width, [&](std::size_t i) { return fmt::format("{}", film.frames[i].step); }) +
         counter(clock, below(72), width, [&](std::size_t i) { return return_text(film.frames[i].predators_return); }) +
         svg_elements(curve.draw()) +
         clock.moved([&](std::size_t i) { return curve.place(i); }, Travel::glides, svg_elements({dot}));
}

}  // namespace folk::mpe
