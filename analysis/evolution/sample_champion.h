#pragma once
// The members of a sample of a class that the ecology of the sample leaves most numerous.

#include <folk/analysis/classes/class_score.h>
#include <folk/analysis/evolution/evolution.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// How the sample is drawn and fed. A winner that tells more than most_leaves kinds of opponents in the class apart is
/// not scored against it.
struct SampleChampionSettings : ClassScoreSettings {
  std::size_t sample = 1000;         ///< different members, each set alike; up to MemoryClass::most_listed
  std::uint64_t seed = 1;            ///< of the draw; the ecology is deterministic
  double population = 100;           ///< of each at the start
  std::uint64_t generations = 1000;  ///< how far to go where no fixed point comes first
};

/// A member that nobody in the sample is more numerous than at the end.
struct SampleWinner {
  std::string member;
  double population = 0;
  std::optional<ClassScore> score;  ///< against the whole class; nothing where it was passed over
};

/// What became of the sample.
struct SampleChampions {
  std::vector<SampleWinner> winners;  ///< as they were drawn
  std::uint64_t generations = 0;
  EvolutionEnd end = EvolutionEnd::none;
  std::uint64_t survivors = 0;  ///< members
  double individuals = 0;
};

/// Plays the sample against itself and lets the ecological competition of Beaufils, Delahaye & Mathieu (1996,
/// IntegerSelection) go on. The result does not depend on the number of threads. Throws UsageError for a sample larger
/// than the class or than can be listed, and what play_tournament, IntegerSelection and score_against throw; Cancelled.
SampleChampions sample_champions(const MemoryClass& members, const SampleChampionSettings& settings,
                                 const Progress& progress = nullptr);

}  // namespace folk
