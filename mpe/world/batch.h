#pragma once
// Episodes of one scenario, stepped together. One episode is the batch of one, to the last bit.

#include <folk/mpe/world/aligned_doubles.h>
#include <folk/mpe/world/block.h>
#include <folk/mpe/world/numpy_random.h>
#include <folk/mpe/world/scenario.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace folk::mpe {

struct Point {
  double x = 0;
  double y = 0;
  bool operator==(const Point&) const = default;
};

/// Everything that the future of an episode depends on.
struct EpisodeState {
  std::vector<Point> positions;   ///< of all entities
  std::vector<Point> velocities;  ///< of the agents; landmarks stand still
  bool operator==(const EpisodeState&) const = default;
};

/// Results do not depend on the number of threads, nor an episode's on how many others stand beside it.
class Batch {
public:
  /// Throws UsageError when the scenario is not sound or there is no episode.
  Batch(const Scenario& scenario, std::size_t episodes, unsigned threads = 1);

  std::size_t size() const { return episodes_; }
  const Layout& layout() const { return layout_; }
  const Scenario& scenario() const { return layout_.scenario(); }

  /// Places everything anew: episode e of this batch becomes number first + e of this seed's episodes. Agents are
  /// uniform in [-1, 1]^2, landmarks in [-0.9, 0.9]^2, all at rest; overlaps are allowed.
  void reset(std::uint64_t seed, std::uint64_t first = 0);

  /// The same for one episode.
  void reset_episode(std::size_t episode, std::uint64_t seed, std::uint64_t number);

  /// Places one episode as the published program does from numpy's random numbers.
  void reset_episode(std::size_t episode, NumpyRandom& random);

  /// Sets an agent's action, a force in units of its acceleration squared; not clipped. Throws UsageError when it is
  /// not finite (or beyond largest_action).
  void set_action(std::size_t episode, std::size_t agent, Point action);

  /// Steps every episode with the actions that are set; they stay set. Throws UsageError, before anything moves, when
  /// one is not finite.
  void step();

  /// An agent's observation now; its size is scenario().observation_size(agent).
  std::vector<double> observation(std::size_t episode, std::size_t agent) const;

  /// An agent's reward of the last step; 0 after a reset.
  double reward(std::size_t episode, std::size_t agent) const;

  EpisodeState state(std::size_t episode) const;

  /// Puts an episode where another was; its observations follow. Throws UsageError when the numbers of entities differ
  /// or something is not finite.
  void set_state(std::size_t episode, const EpisodeState& state);

  /// The batch in blocks of 64 episodes, for those who step them themselves.
  std::size_t blocks() const { return blocks_; }
  Block block(std::size_t b);

private:
  struct Place {
    Block block;
    std::size_t lane;
  };
  Place place(std::size_t episode) const;
  void place_at_random(std::size_t episode, std::uint64_t seed, std::uint64_t number);
  void set_positions(std::size_t episode, std::span<const Point> positions);
  void observe_episode(std::size_t episode);

  Layout layout_;
  std::size_t episodes_;
  std::size_t blocks_;
  unsigned threads_;
  AlignedDoubles state_;
  AlignedDoubles actions_;
  AlignedDoubles observations_;
  AlignedDoubles rewards_;
};

}  // namespace folk::mpe
