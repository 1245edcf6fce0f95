#pragma once
// The transitions that a learner draws its batches from: the last so many episodes.

#include <folk/mpe/world/block.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk::mpe {

/// A ring of rounds of round_episodes episodes. A row holds what was seen at one moment, what was done, and what that
/// earned: [observations of all agents | actions of all agents | reward of a predator, of the prey], and each episode
/// has one row more than steps: its last says what was seen at the end, and what the prey would have done then.
class ReplayMemory {
public:
  ReplayMemory(const Layout& layout, std::size_t transitions);

  /// Where a transition lies: its row, and the row after it.
  struct Transition {
    const float* now;
    const float* next;
  };

  std::size_t transitions() const { return rounds_held() * transitions_per_round_; }
  std::size_t rounds() const { return rounds_; }      ///< that were ever begun
  std::size_t rounds_held() const;                    ///< of them, those that are still there
  std::size_t capacity() const { return capacity_; }  ///< in rounds

  std::size_t observations() const { return observations_; }  ///< numbers of all agents
  std::size_t actions() const { return actions_; }

  /// Empties the memory; the next round is this one.
  void begin_at(std::size_t round);

  /// Begins a round, over the oldest when the ring is full; observe and act then fill it in.
  void begin_round();

  /// Row `step` of each episode of the round: what is seen; steps of an episode, the last included.
  void observe(const Layout& layout, const Block& block, std::size_t step);
  /// What all agents do now; in the last row the prey's counts alone.
  void act(const Layout& layout, const Block& block, std::size_t step);
  /// What the step earned.
  void reward(const Layout& layout, const Block& block, std::size_t step);

  /// Transition number i below transitions().
  Transition transition(std::size_t i) const;

  /// The actions of a round that is held, [episode][step][action], steps + 1 of them: with the episodes' numbers all
  /// that the round can be made from again.
  std::vector<float> round_actions(std::size_t round) const;

private:
  float* row(std::size_t round, std::size_t episode, std::size_t step);
  const float* row(std::size_t round, std::size_t episode, std::size_t step) const;

  std::size_t observations_;
  std::size_t actions_;
  std::size_t width_;
  std::size_t steps_;
  std::size_t transitions_per_round_;
  std::size_t capacity_;
  std::size_t first_ = 0;  // the oldest round that may be there
  std::size_t rounds_ = 0;
  std::vector<float> rows_;
};

}  // namespace folk::mpe
