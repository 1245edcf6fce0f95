#pragma once
// Sixty-four episodes as arrays: the unit in which the world is stepped.
//
// A block has rows of 64 doubles, one an episode. Of the state: for each agent its position and velocity (px, py, vx,
// vy), then for each landmark its place (px, py). Of the actions: (ux, uy) of each agent. Of the observations: those of
// agent 0, of agent 1, ... Of the rewards: one an agent.

#include <folk/mpe/world/lanes.h>
#include <folk/mpe/world/scenario.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace folk::mpe {

/// A scenario as the step reads it: rows and pairs found once.
class Layout {
public:
  /// Throws UsageError when the scenario is not sound.
  explicit Layout(Scenario scenario);

  const Scenario& scenario() const { return scenario_; }
  std::size_t agents() const { return agents_; }
  std::size_t landmarks() const { return landmarks_; }

  std::size_t state_rows() const { return 4 * agents_ + 2 * landmarks_; }
  std::size_t action_rows() const { return 2 * agents_; }
  std::size_t observation_rows() const { return observation_begin_.back(); }
  std::size_t reward_rows() const { return agents_; }

  /// The row of an entity's px; py follows, and for an agent vx and vy.
  std::size_t position_row(std::size_t entity) const {
    return entity < agents_ ? 4 * entity : 4 * agents_ + 2 * (entity - agents_);
  }

  /// Rows [observation_begin(i), observation_begin(i + 1)) are what agent i observes.
  std::size_t observation_begin(std::size_t agent) const { return observation_begin_[agent]; }

  /// Two entities that may touch, a < b, at least one of which moves.
  struct Pair {
    std::size_t a = 0;
    std::size_t b = 0;
    double touching = 0;     ///< the sum of the radii
    double near_square = 0;  ///< beyond this squared distance the contact force is below 1e-16 and left out
    bool b_moves = false;
  };
  const std::vector<Pair>& pairs() const { return pairs_; }
  const std::vector<std::size_t>& food() const { return food_; }
  const std::vector<std::size_t>& forests() const { return forests_; }

private:
  Scenario scenario_;
  std::size_t agents_ = 0;
  std::size_t landmarks_ = 0;
  std::vector<std::size_t> observation_begin_;
  std::vector<Pair> pairs_;
  std::vector<std::size_t> food_;
  std::vector<std::size_t> forests_;
};

/// A block's arrays, each 64-byte aligned.
struct Block {
  double* state = nullptr;         ///< [state_rows][64]
  double* actions = nullptr;       ///< [action_rows][64]
  double* observations = nullptr;  ///< [observation_rows][64]
  double* rewards = nullptr;       ///< [reward_rows][64]
  std::size_t lanes = 0;           ///< episodes in it; a multiple of 8 is computed
};

/// The largest action that is taken, far above any that makes sense: beyond it the physics would overflow.
inline constexpr double largest_action = 1e100;

/// The first (agent, lane) of the block whose action is not finite or larger than largest_action.
struct BadAction {
  std::size_t agent = 0;
  std::size_t lane = 0;
};
std::optional<BadAction> find_bad_action(const Layout& layout, const Block& block);

/// Where observations and rewards go: through the caches, or past them when they will not be read soon.
enum class Stores { cached, past_caches };

/// One step of all its episodes: contact and control forces, velocities, positions; then observations and rewards of
/// the new state. The actions must be fit (find_bad_action).
void step(const Layout& layout, const Block& block, Stores stores = Stores::cached);

/// Observations of the state as it is, as after a reset; rewards are set to 0.
void observe(const Layout& layout, const Block& block);

}  // namespace folk::mpe
