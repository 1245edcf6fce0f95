#pragma once
// The way of a class's ecology told by few: the behaviours that are most numerous in the end, and all others together.

#include <folk/analysis/evolution/class_selection.h>
#include <folk/analysis/evolution/evolution.h>
#include <folk/games/progress.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace folk {

/// Individuals of a behaviour are those of all members that have it.
struct LeadingBehaviours {
  std::vector<std::uint32_t> members;  ///< of each leading behaviour the first member, most numerous first
  std::size_t others = 0;              ///< further behaviours
  /// A row a generation: the individuals of each leading behaviour, last those of all others.
  std::vector<PopulationHistory::Row> rows;
};

/// Looks for at most `most` leaders in `reached`, and goes there once more from `start`: an evolution keeps too few of
/// the populations of a class. Behaviours without individuals do not lead. Throws Cancelled.
LeadingBehaviours leading_behaviours(const std::shared_ptr<const ClassSelection>& selection, const Population& start,
                                     const EvolutionState& reached, std::size_t most,
                                     const Progress& progress = nullptr);

}  // namespace folk
