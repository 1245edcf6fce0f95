#pragma once
// The columns of recorded episodes and the order in which a row's numbers stand in them.
//
// For each entity ENTITY.px, .py, .vx, .vy, where the entities are agent0, agent1, ..., landmark0, ... (the obstacles),
// food0, ... and forest0, ...; for each agent i the action that led here, acti.x and acti.y; then obsi.0,
// obsi.1, ... of each agent; then each agent's rewi. Landmarks have velocities too: 0.

#include <folk/mpe/evaluation/episode_record.h>

#include <span>
#include <string>
#include <vector>

namespace folk::mpe {

/// What the number in a column is.
enum class Quantity { state, action, observation, reward };

struct RecordingColumn {
  std::string name;
  Quantity quantity = Quantity::state;
};

/// The columns after `episode` and `t`.
std::vector<RecordingColumn> recording_columns(const Scenario& scenario);

/// A row's numbers in the order of the columns. Throws UsageError when the row is not of this scenario.
std::vector<double> to_numbers(const Scenario& scenario, const EpisodeRecord::Row& row);

/// The row of these numbers, one a column; the velocities of landmarks are not kept.
EpisodeRecord::Row row_of_numbers(const Scenario& scenario, std::span<const double> numbers);

}  // namespace folk::mpe
