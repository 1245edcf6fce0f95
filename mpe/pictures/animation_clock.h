#pragma once
// The time of an animated picture: a frame after another, a rest, and round again. Its words are SMIL's, as browsers
// know them.

#include <folk/mpe/world/batch.h>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace folk::mpe {

class AnimationClock {
public:
  static constexpr double frame_seconds = 0.25;
  static constexpr std::size_t frames_at_rest = 6;  ///< for so long the last frame stays

  explicit AnimationClock(std::size_t frames)
      : frames_(frames) {}

  std::size_t last() const { return frames_ - 1; }

  /// An attribute with a number for each frame, between which it changes evenly.
  std::string glide(std::string_view attribute, const std::function<double(std::size_t)>& value) const;

  /// An attribute with one of two values in each frame, which lasts until the next.
  std::string jump(std::string_view attribute, const std::function<bool(std::size_t)>& on, std::string_view value_on,
                   std::string_view value_off) const;

  /// Elements that travel from place to place in straight lines, as agents do in the world, or jump there. Where
  /// nothing moves they are at the last place.
  enum class Travel { glides, jumps };
  std::string moved(const std::function<Point(std::size_t)>& place, Travel travel, std::string_view elements) const;

private:
  std::string duration() const;
  std::string values(std::size_t count, const std::function<std::string(std::size_t)>& value) const;

  std::size_t frames_;
};

}  // namespace folk::mpe
