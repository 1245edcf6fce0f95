#pragma once
// Which of the matches in a data set deserve to be imitated, and where it matters.

#include <folk/sct/data/trajectory.h>
#include <folk/sct/data/windows.h>

#include <vector>

namespace folk::sct {

/// How sharply good matches are told from bad ones, in units of the payoffs.
struct RegretTemperatures {
  double move = 3;        ///< between matches that had the same play so far
  double situation = 20;  ///< between situations with the same opponent
};

/// Weighs each round in the policy loss by what the data say of its move (advantage-weighted regression, Peng et al.
/// 2019, with the advantages read off the data, situation by situation).
///
/// A situation is an opponent and the play so far; its matches are those of the data that have both. Within one, the
/// weights are the softmax of earned / move. All of them are multiplied by
///   sqrt(|best match that now plays C - best that now plays D|), what hangs on the move (1 where only one was played),
///   exp((best match of the situation - best match against this opponent) / situation): a spoilt situation is no model.
/// Every opponent weighs the same as long as it may still be met. `lessons[i]` is of `trajectories[i]`. The names of
/// the opponents are all that tells them apart, though no network ever sees them: throws UsageError where one is empty.
void weigh_by_regret(const std::vector<Trajectory>& trajectories, const RegretTemperatures& temperatures,
                     std::vector<Lesson>& lessons);

}  // namespace folk::sct
