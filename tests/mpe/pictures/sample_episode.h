#pragma once
// A short episode made by hand, whose contacts and returns are known.

#include <folk/mpe/evaluation/episode_record.h>

#include <array>
#include <string>

namespace folk::test {

/// Six moments of simple_tag. The prey stays at (0, 0.5); predator 1 touches it at steps 2 and 3, predator 0 at step 3;
/// predator 2 and the obstacles are far away. A predator's return so far: 0, -1, 9, 29, 28, 27.
inline mpe::EpisodeRecord sample_episode() {
  mpe::EpisodeRecord record{mpe::Scenario::named("simple_tag"), {}, "lead_pursuit", "still", 7, 3};
  const std::array<double, 6> rewards{0, -1, 10, 20, -1, -1};
  for (std::size_t step = 0; step < rewards.size(); ++step) {
    const double x0 = step == 3 ? -0.1 : -0.5 - 0.01 * static_cast<double>(step);
    const double x1 = step == 2 || step == 3 ? 0.1 : 0.5 + 0.01 * static_cast<double>(step);
    mpe::EpisodeRecord::Row row;
    row.state.positions = {{x0, 0.5}, {x1, 0.5}, {0.9, -0.9}, {0, 0.5}, {-0.5, -0.5}, {0.5, -0.5}};
    row.state.velocities.assign(4, mpe::Point{});
    row.actions.assign(4, mpe::Point{});
    row.observations.assign(4, {});
    row.rewards.assign(4, rewards[step]);
    record.rows.push_back(row);
  }
  return record;
}

inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

}  // namespace folk::test
