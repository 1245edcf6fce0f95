#pragma once
// Situations of the particle world to try it on: spread out, far outside, piled up, one on top of the other.

#include <folk/mpe/world/batch.h>

#include <rapidcheck.h>

#include <cstddef>
#include <ostream>
#include <utility>
#include <vector>

namespace folk::mpe::testing {

/// Places are multiples of this, so that entities often stand in one point, and no two of them at the very distance at
/// which they begin to touch, where the last bit would decide.
inline constexpr double grid = 0.0271;

/// Numbers from -most to most on the grid.
inline rc::Gen<Point> any_point(double most) {
  const int steps = static_cast<int>(most / grid);
  return rc::gen::map(rc::gen::pair(rc::gen::inRange(-steps, steps + 1), rc::gen::inRange(-steps, steps + 1)),
                      [](const std::pair<int, int>& at) {
                        return Point{at.first * grid, at.second * grid};
                      });
}

inline rc::Gen<std::vector<Point>> any_points(std::size_t count, double most) {
  return rc::gen::container<std::vector<Point>>(count, any_point(most));
}

/// A state of a scenario: in the arena, all in a heap, or up to 30 away.
inline rc::Gen<EpisodeState> any_state(const Scenario& scenario) {
  const std::size_t entities = scenario.entities.size();
  return rc::gen::map(rc::gen::pair(rc::gen::oneOf(any_points(entities, 1.2), any_points(entities, 0.2),
                                                   any_points(entities, 0.06), any_points(entities, 30)),
                                    any_points(scenario.agents(), 1.4)),
                      [](std::pair<std::vector<Point>, std::vector<Point>> numbers) {
                        return EpisodeState{std::move(numbers.first), std::move(numbers.second)};
                      });
}

/// An action for each agent, |u| up to 10.
inline rc::Gen<std::vector<Point>> any_actions(const Scenario& scenario) {
  return rc::gen::oneOf(any_points(scenario.agents(), 1), any_points(scenario.agents(), 10));
}

}  // namespace folk::mpe::testing

namespace folk::mpe {

// What RapidCheck writes of them when a property fails.
inline void showValue(const Point& point, std::ostream& os) { os << "(" << point.x << ", " << point.y << ")"; }
inline void showValue(const EpisodeState& state, std::ostream& os) {
  os << "positions ";
  rc::show(state.positions, os);
  os << ", velocities ";
  rc::show(state.velocities, os);
}

}  // namespace folk::mpe
