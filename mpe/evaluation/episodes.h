#pragma once
// Whole episodes, played block by block: a block of 64 is taken from reset to end while it is in the cache.

#include <folk/games/progress.h>
#include <folk/mpe/players/player.h>
#include <folk/mpe/world/batch.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace folk::mpe {

/// Looks on while a block's episodes are played. Lanes from `block.lanes` on mean nothing.
class Watcher {
public:
  virtual ~Watcher() = default;

  /// All agents have chosen: block.observations are what they saw, block.actions what they will do.
  virtual void acted(const Layout&, const Block&, const Moment&) {}

  /// The step is taken: state, observations and rewards are those after it; moment.step counts it.
  virtual void stepped(const Layout&, const Block&, const Moment&) {}
};

/// Which episodes of a seed are played, and on how many threads; results do not depend on the threads.
struct EpisodePlan {
  std::uint64_t seed = 1;
  std::uint64_t first = 0;
  std::size_t episodes = 100;
  unsigned threads = 1;

  /// Places the batch's episode, which is `number` of the seed, otherwise than Batch::reset has; several threads may
  /// call it at once.
  std::function<void(Batch& batch, std::size_t episode, std::uint64_t number)> place = nullptr;
};

/// Plays them, scenario.episode_steps each. `watcher(i)` is asked for the one who looks on while episodes first + i and
/// on, up to 64 of them, are played; it may be called by several threads at once. `progress` is told the share that is
/// done. Throws UsageError, naming the player, when an action is not finite, and Cancelled.
void play_episodes(const Layout& layout, const Cast& cast, const EpisodePlan& plan,
                   const std::function<std::unique_ptr<Watcher>(std::size_t)>& watcher,
                   const Progress& progress = nullptr);

/// What is said of one episode.
struct EpisodeScore {
  double predators = 0;      ///< undiscounted sum of one predator's rewards; all predators earn the same
  double prey = 0;           ///< of the prey's
  double contacts = 0;       ///< predators touching the prey, added up over the steps
  double caught_steps = 0;   ///< steps in which at least one touches it
  double distance = 0;       ///< mean distance of predators and prey over predators and steps
  double nearest = 0;        ///< mean distance of the nearest predator over the steps
  double outside_steps = 0;  ///< steps with the prey outside [-1, 1]^2
};

/// Adds up the scores of a block's episodes at `scores`, one after the other.
std::unique_ptr<Watcher> scoring(EpisodeScore* scores);

/// The scores of the planned episodes, in their order.
std::vector<EpisodeScore> score_episodes(const Layout& layout, const Cast& cast, const EpisodePlan& plan,
                                         const Progress& progress = nullptr);

}  // namespace folk::mpe
