#pragma once
// A recorded episode played again: does this world do what was recorded?

#include <folk/mpe/evaluation/episode_record.h>

#include <cstddef>
#include <string>

namespace folk::mpe {

/// From where the steps of a replay are taken.
enum class ReplayMode {
  one_step,  ///< each from the recorded state before it: errors do not add up
  free_run   ///< all from the first state, with the recorded actions; pile-ups are chaotic
};

/// The largest |replayed - recorded| of some columns, and where it is first reached. NaN counts as larger than any
/// number.
struct Deviation {
  double size = 0;
  std::size_t step = 0;  ///< the row, t
  std::string column{};  ///< "agent0.px", "obs3.7", "rew0"; empty when nothing deviates

  bool within(double tolerance) const { return size <= tolerance; }
};

struct ReplayResult {
  std::size_t steps = 0;
  Deviation state;
  Deviation observation;
  Deviation reward;

  /// The largest of the three.
  const Deviation& largest() const;
  bool within(double tolerance) const { return largest().within(tolerance); }
};

/// True when the first deviates less; NaN never does.
bool less(const Deviation& one, const Deviation& other);

/// Plays the recorded actions in the record's scenario and compares every row: of the first the observations and, as 0,
/// the rewards; of a later one the state that its action led to, observations and rewards. Throws UsageError when the
/// record has no step, a row is not one of its scenario, or a state or action is not finite.
ReplayResult replay(const EpisodeRecord& record, ReplayMode mode = ReplayMode::one_step);

}  // namespace folk::mpe
