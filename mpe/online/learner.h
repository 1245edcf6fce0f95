#pragma once
// Deterministic policy gradients with centralised (or own) critics for several agents: MADDPG and MATD3.

#include <folk/analysis/play/workers.h>
#include <folk/mpe/network/policy_network.h>
#include <folk/mpe/online/replay_memory.h>
#include <folk/mpe/online/settings.h>
#include <folk/sct/training/adamw.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace folk::mpe {

/// A network that learns: its parameters, those of its target, and Adam's moments.
struct LearningNetwork {
  std::vector<float> parameters;
  std::vector<float> target;
  sct::AdamWState<float> optimiser;
};

/// What an agent learns with.
struct LearningAgent {
  LearningNetwork actor;
  std::vector<LearningNetwork> critics;  ///< one or two
};

/// Losses of an update, means over the agents that learn.
struct OnlineLosses {
  double critic = 0;            ///< mean square of a critic's error
  std::optional<double> value;  ///< mean value of what the actors would do, where they moved
};

/// The agents that learn, in their order, and the update of all of them. An update draws from its number alone, and its
/// bits do not depend on the number of threads.
class Learner {
public:
  Learner(const Layout& layout, const OnlineSettings& settings);
  ~Learner();

  /// Which agents learn: the predators, then perhaps the prey.
  std::size_t agents() const { return state_.size(); }

  const MlpShape& actor_shape(std::size_t agent) const { return actor_shapes_[agent]; }
  const MlpShape& critic_shape(std::size_t agent) const { return critic_shapes_[agent]; }

  PolicyNetwork policy(std::size_t agent) const;

  /// Draws a batch, moves the critics of all agents a step, and every actor_every() updates the actors and all targets.
  /// `rate`: the learning rate of now.
  OnlineLosses update(const ReplayMemory& memory, double rate);

  std::uint64_t updates() const { return updates_; }

  const std::vector<LearningAgent>& state() const { return state_; }

  /// Goes on from a state. Throws UsageError when its sizes are not this learner's.
  void restore(std::vector<LearningAgent> state, std::uint64_t updates);

private:
  struct Piece;  // a part of the batch, and what is computed of it

  void gather(const ReplayMemory& memory, std::size_t piece);
  void choose_target_actions(Piece& piece, std::size_t number);
  void critic_gradient(Piece& piece, std::size_t agent);
  void actor_gradient(Piece& piece, std::size_t agent);
  void descend(LearningNetwork& network, std::size_t agent, std::size_t which, double rate);
  void follow(LearningNetwork& network) const;
  const Matrix<float>& critic_input(Piece& piece, std::size_t agent, bool next) const;

  const Layout& layout_;
  OnlineSettings settings_;
  std::vector<MlpShape> actor_shapes_;
  std::vector<MlpShape> critic_shapes_;
  std::vector<LearningAgent> state_;
  std::uint64_t updates_ = 0;
  std::vector<std::unique_ptr<Piece>> pieces_;
  Workers workers_;
};

}  // namespace folk::mpe
