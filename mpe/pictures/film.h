#pragma once
// An episode as it is shown: its frames, and what is written above them.

#include <folk/mpe/evaluation/episode_record.h>

#include <cstddef>
#include <string>
#include <vector>

namespace folk::mpe {

struct Frame {
  std::size_t step = 0;
  std::vector<Point> positions;  ///< of all entities
  std::vector<bool> touching;    ///< of each agent: a predator and the prey that touch, as rewards count it
  double predators_return = 0;   ///< the undiscounted sum of one predator's rewards so far
};

struct Film {
  Scenario scenario;
  std::string title;          ///< the scenario and who played
  std::string subtitle;       ///< which episode, and what came out
  std::string caption;        ///< the scenario, the steps, Folk's version
  std::vector<Frame> frames;  ///< at least one

  std::size_t steps() const { return frames.back().step; }
};

/// Whole numbers equally spaced from 0 to count - 1, both included, at most `most` of them (at least 2).
std::vector<std::size_t> equally_spaced(std::size_t count, std::size_t most);

/// All rows of an episode, or `most` equally spaced ones, the first and the last included; a frame then also shows the
/// contacts since the one before it. Throws UsageError when there is no row, when a row does not fit the scenario, or
/// when something in it is not finite.
Film film_of(const EpisodeRecord& record, std::size_t most);

/// A return as it is written, to a tenth.
std::string return_text(double value);

}  // namespace folk::mpe
