#include <folk/mpe/pictures/animation_clock.h>
#include <folk/mpe/pictures/svg_shapes.h>

#include <fmt/format.h>

#include <algorithm>

namespace folk::mpe {

std::string AnimationClock::duration() const {
  return fmt::format("dur=\"{}s\" repeatCount=\"indefinite\"",
                     frame_seconds * static_cast<double>(last() + frames_at_rest));
}

/// The last frame's value is kept at rest.
std::string AnimationClock::values(std::size_t count, const std::function<std::string(std::size_t)>& value) const {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ';';
    text += value(std::min(i, last()));
  }
  return text;
}

std::string AnimationClock::glide(std::string_view attribute, const std::function<double(std::size_t)>& value) const {
  return fmt::format("<animate attributeName=\"{}\" {} values=\"{}\"/>", attribute, duration(),
                     values(frames_ + frames_at_rest, [&](std::size_t i) { return svg_number(value(i)); }));
}

std::string AnimationClock::jump(std::string_view attribute, const std::function<bool(std::size_t)>& on,
                                 std::string_view value_on, std::string_view value_off) const {
  std::string values;
  std::string times;
  for (std::size_t i = 0; i < frames_; ++i) {
    if (i > 0 && on(i) == on(i - 1)) continue;
    values += fmt::format("{}{}", i == 0 ? "" : ";", on(i) ? value_on : value_off);
    times += fmt::format("{}{:.4g}", i == 0 ? "" : ";",
                         static_cast<double>(i) / static_cast<double>(last() + frames_at_rest));
  }
  return fmt::format("<animate attributeName=\"{}\" calcMode=\"discrete\" {} values=\"{}\" keyTimes=\"{}\"/>",
                     attribute, duration(), values, times);
}

std::string AnimationClock::moved(const std::function<Point(std::size_t)>& place, Travel travel,
                                  std::string_view elements) const {
  const auto text = [&](std::size_t frame) {
    const Point at = place(frame);
    return svg_number(at.x) + " " + svg_number(at.y);
  };
  // Of n values that jump each lasts an nth of the time; that glide, each but the last begins an (n - 1)th.
  const bool glides = travel == Travel::glides;
  return fmt::format(
      "<g transform=\"translate({})\"><animateTransform attributeName=\"transform\" type=\"translate\" {}{} "
      "values=\"{}\"/>\n{}</g>\n",
      text(last()), glides ? "" : "calcMode=\"discrete\" ", duration(),
      values(last() + frames_at_rest + (glides ? 1 : 0), text), elements);
}

}  // namespace folk::mpe
