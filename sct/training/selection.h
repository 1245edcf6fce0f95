#pragma once
// The written rule by which one of all the policies of a training run is kept.
//
// 1. Every so many steps and at the end the policy plays its validation matches once for each target of a grid: against
//    every member of the roster, in repetitions whose moves flip with some probability (or never), drawn from a seed
//    that nothing in training draws from.
//    With a held-out roster it plays that one in the same way, and its totals there are what counts below.
// 2. The policy's figure is the mean total of its best target; of equal targets the lowest counts.
// 3. The policy with the highest figure is kept, of equal ones the latest (it has seen more, and the learning rate has
//    fallen further), and plays with that target.
// 4. With a patience of N the run ends at the Nth evaluation in a row whose figure is no higher than all before.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace folk::sct {

/// How a policy fares against a roster that nothing in training meets.
struct HeldOutScore {
  double total = 0;                ///< as in TargetScore
  std::optional<double> accuracy;  ///< of its beliefs

  bool operator==(const HeldOutScore&) const = default;
};

/// How a policy fares in its validation matches when it is asked for this return.
struct TargetScore {
  double target = 0;                       ///< unscaled
  double total = 0;                        ///< over the roster, mean over the repetitions
  std::optional<double> accuracy;          ///< of its beliefs
  std::optional<HeldOutScore> held_out{};  ///< where there is such a roster

  /// What the rule goes by.
  double figure() const { return held_out ? held_out->total : total; }

  bool operator==(const TargetScore&) const = default;
};

/// The policy as it was after so many steps.
struct Evaluation {
  std::uint64_t steps = 0;
  double belief_loss = 0;  ///< mean over the steps since the evaluation before
  double action_loss = 0;
  std::vector<TargetScore> scores;  ///< in the order of the grid, at least one

  bool operator==(const Evaluation&) const = default;
};

/// Part 2 of the rule.
const TargetScore& best_target(const Evaluation& evaluation);

/// Part 3: whether a later policy takes the place of the one that is kept.
bool takes_over(const Evaluation& later, const Evaluation& kept);

/// Part 4: the index of the evaluation at which patience ends, were there evaluations without end; nothing where it
/// lasts through all of these, as a patience of 0 always does.
std::optional<std::size_t> end_of_patience(const std::vector<Evaluation>& history, std::uint64_t patience);

}  // namespace folk::sct
