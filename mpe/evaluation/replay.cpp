#include <folk/games/error.h>
#include <folk/mpe/evaluation/recording_columns.h>
#include <folk/mpe/evaluation/replay.h>
#include <folk/mpe/world/batch.h>

#include <cmath>

namespace folk::mpe {
namespace {

/// The only episode of a batch as a row; the action is the recorded one.
EpisodeRecord::Row row_of(const Batch& batch, const std::vector<Point>& actions) {
  EpisodeRecord::Row row{batch.state(0), actions, {}, {}};
  for (std::size_t agent = 0; agent < batch.layout().agents(); ++agent) {
    row.observations.push_back(batch.observation(0, agent));
    row.rewards.push_back(batch.reward(0, agent));
  }
  return row;
}

/// Keeps the largest deviations of the rows that it is shown.
class Comparison {
public:
  explicit Comparison(const Scenario& scenario)
      : scenario_(scenario),
        columns_(recording_columns(scenario)) {}

  void compare(std::size_t step, const EpisodeRecord::Row& replayed, const EpisodeRecord::Row& recorded) {
    const auto ours = to_numbers(scenario_, replayed);
    const auto theirs = to_numbers(scenario_, recorded);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      Deviation* kept = of(columns_[c].quantity);
      if (kept == nullptr) continue;
      Deviation here{std::abs(ours[c] - theirs[c]), step, columns_[c].name};
      if (less(*kept, here)) *kept = std::move(here);
    }
  }

  const ReplayResult& result() const { return result_; }

private:
  /// Null for what is given, not compared.
  Deviation* of(Quantity quantity) {
    switch (quantity) {
      case Quantity::state: return &result_.state;
      case Quantity::observation: return &result_.observation;
      case Quantity::reward: return &result_.reward;
      case Quantity::action: break;
    }
    return nullptr;
  }

  const Scenario& scenario_;
  std::vector<RecordingColumn> columns_;
  ReplayResult result_;
};

}  // namespace

bool less(const Deviation& one, const Deviation& other) { return !std::isnan(one.size) && !(one.size >= other.size); }

const Deviation& ReplayResult::largest() const {
  const Deviation& larger = less(state, observation) ? observation : state;
  return less(larger, reward) ? reward : larger;
}

ReplayResult replay(const EpisodeRecord& record, ReplayMode mode) {
  if (record.rows.size() < 2) throw UsageError("a recorded episode without a step: there is nothing to replay");
  Comparison comparison(record.scenario);
  Batch batch(record.scenario, 1);
  batch.set_state(0, record.rows.front().state);
  comparison.compare(0, row_of(batch, record.rows.front().actions), record.rows.front());
  for (std::size_t t = 1; t < record.rows.size(); ++t) {
    const auto& row = record.rows[t];
    if (mode == ReplayMode::one_step) batch.set_state(0, record.rows[t - 1].state);
    for (std::size_t agent = 0; agent < row.actions.size(); ++agent) batch.set_action(0, agent, row.actions[agent]);
    batch.step();
    comparison.compare(t, row_of(batch, row.actions), row);
  }
  ReplayResult result = comparison.result();
  result.steps = record.rows.size() - 1;
  return result;
}

}  // namespace folk::mpe
