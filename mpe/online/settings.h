#pragma once
// What an online training run of the particle world depends on.

#include <folk/mpe/world/scenario.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace folk::mpe {

/// How actors and critics learn.
enum class Algorithm {
  maddpg,  ///< one critic, actor and targets follow at each update (Lowe et al. 2017)
  matd3    ///< twin critics whose smaller value counts, actor and targets follow every second update (Ackermann et al.
           ///< 2019)
};

/// What a critic sees.
enum class Critic {
  centralised,  ///< observations and actions of all agents
  independent   ///< those of its own agent alone: what OMAR calls MATD3
};

/// Defaults are those of Ackermann et al.'s program, but for what says so.
struct OnlineSettings {
  Algorithm algorithm = Algorithm::matd3;
  Critic critic = Critic::centralised;
  bool prey_learns = false;
  std::size_t hidden = 64;  ///< units in each of two hidden layers
  double learning_rate = 1e-2;
  double final_learning_rate = 1e-2;  ///< reached along a half cosine at the last episode
  double discount = 0.95;
  std::size_t batch = 1024;
  std::size_t memory = 1'000'000;     ///< transitions that are kept
  std::size_t first_update = 25'600;  ///< transitions before learning begins
  std::size_t update_every = 100;     ///< transitions
  double averaging = 0.01;            ///< tau, a step of the target networks
  double clip = 0.5;                  ///< largest norm of a network's gradient
  double action_penalty = 1e-3;       ///< on the square of an action before tanh
  double exploration = 0.1;           ///< deviation of the noise on actions in training
  double final_exploration = 0.1;     ///< at the last episode
  double target_noise = 0;            ///< deviation of the noise on the targets' actions; TD3 has 0.2
  double target_noise_clip = 0.5;
  std::size_t episodes = 60'000;
  std::size_t evaluate_every = 1'920;  ///< episodes; rounded up to whole rounds
  std::size_t evaluation_episodes = 512;
  std::uint64_t evaluation_seed = 1'000'003;
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< changes no bit of the result

  std::size_t critics() const { return algorithm == Algorithm::matd3 ? 2 : 1; }
  std::size_t actor_every() const { return algorithm == Algorithm::matd3 ? 2 : 1; }
};

/// Episodes are played and learned from in rounds of a block.
inline constexpr std::size_t round_episodes = 64;

/// Throws UsageError, naming the setting, when one is out of range.
void require_sound(const OnlineSettings& settings);

std::string_view to_string(Algorithm algorithm);
std::string_view to_string(Critic critic);

}  // namespace folk::mpe
