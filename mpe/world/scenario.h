#pragma once
// What a particle world is made of, as data: who and what is in it, how large and how fast, and what is rewarded.
//
// The two scenarios are those of the published program of Li, Guevara, Xie & Zhu (arXiv 2310.04579), itself a
// descendant of the multi-agent particle environments (Lowe et al. 2017; Mordatch & Abbeel 2018). docs/mpe.md has every
// number.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

inline constexpr std::size_t most_entities = 32;

/// What an entity is. Predators come first, then the prey: these are the agents, they move. The rest are landmarks.
enum class Role { predator, prey, obstacle, food, forest };

struct Entity {
  std::string name;  ///< "agent0", "landmark1": as in recorded episodes
  Role role = Role::predator;
  double radius = 0;
  double acceleration = 0;  ///< A: an action u is a force of A * A * u
  double max_speed = 0;

  bool moves() const { return role == Role::predator || role == Role::prey; }
  bool collides() const { return moves() || role == Role::obstacle; }
};

/// How rewards are written down.
enum class RewardRule {
  program,  ///< as the published program: distances always, catches on top
  paper     ///< as the paper's text: for predators the catches where there are any, otherwise the distances
};

/// Weights of the rewards; all predators get the same.
struct Rewards {
  RewardRule rule = RewardRule::program;
  double distance = 0.1;     ///< a unit of distance between the prey and each predator
  double catching = 0;       ///< a predator that touches the prey
  double boundary = 0;       ///< the prey's penalty outside [-0.9, 0.9], see boundary_penalty
  double eating = 0;         ///< the prey on a piece of food
  double food_distance = 0;  ///< a unit of distance between the prey and the nearest food; the program rewards it
};

/// The physics, the same in both scenarios.
struct Physics {
  double time_step = 0.1;
  double damping = 0.25;  ///< the share of a velocity that is lost in a step
  double contact_force = 100;
  double contact_margin = 1e-3;
};

struct Scenario {
  std::string name;
  std::vector<Entity> entities;  ///< predators, the prey, landmarks in the order in which they are observed
  Rewards rewards;
  Physics physics;
  std::size_t episode_steps = 25;

  std::size_t agents() const;     ///< predators and the prey
  std::size_t predators() const;  ///< agents() - 1
  std::size_t prey() const { return predators(); }
  std::size_t landmarks() const { return entities.size() - agents(); }
  std::size_t count(Role role) const;

  /// How many numbers an agent observes: its velocity and position, the places of all landmarks and then of all other
  /// agents from where it is, for predators the prey's velocity, and for each forest +1 inside and -1 outside.
  std::size_t observation_size(std::size_t agent) const;
  std::size_t observation_sizes() const;  ///< of all agents, added up

  /// The scenarios by name: simple_tag, simple_world. Throws UsageError, naming them, on any other.
  static Scenario named(std::string_view name, RewardRule rule = RewardRule::program);
};

/// Throws UsageError unless the agents are one or more predators and then one prey, before all landmarks, and every
/// number is finite and in range: radii, accelerations and top speeds above 0.
void require_sound(const Scenario& scenario);

/// B(x) of the prey's distance x from an axis: 0 below 0.9, then a slope of 10 up to 1, then exp(2 x - 2), at most 10.
double boundary_penalty(double x);

std::string_view to_string(RewardRule rule);

}  // namespace folk::mpe
