#include <folk/mpe/online/replay_memory.h>
#include <folk/mpe/online/settings.h>

#include <algorithm>

namespace folk::mpe {

ReplayMemory::ReplayMemory(const Layout& layout, std::size_t transitions)
    : observations_(layout.observation_rows()),
      actions_(layout.action_rows()),
      width_(observations_ + actions_ + 2),
      steps_(layout.scenario().episode_steps),
      transitions_per_round_(steps_ * round_episodes),
      capacity_(std::max<std::size_t>(1, transitions / transitions_per_round_)) {}

std::size_t ReplayMemory::rounds_held() const { return std::min(rounds_ - first_, capacity_); }

float* ReplayMemory::row(std::size_t round, std::size_t episode, std::size_t step) {
  return rows_.data() + (((round % capacity_) * round_episodes + episode) * (steps_ + 1) + step) * width_;
}

const float* ReplayMemory::row(std::size_t round, std::size_t episode, std::size_t step) const {
  return const_cast<ReplayMemory*>(this)->row(round, episode, step);
}

void ReplayMemory::begin_at(std::size_t round) { first_ = rounds_ = round; }

void ReplayMemory::begin_round() {
  ++rounds_;
  const std::size_t places = std::min(rounds_, capacity_);
  const std::size_t needed = places * round_episodes * (steps_ + 1) * width_;
  if (rows_.size() < needed) rows_.resize(needed);
}

void ReplayMemory::observe(const Layout& layout, const Block& block, std::size_t step) {
  for (std::size_t lane = 0; lane < round_episodes; ++lane) {
    float* to = row(rounds_ - 1, lane, step);
    for (std::size_t k = 0; k < layout.observation_rows(); ++k)
      to[k] = static_cast<float>(block.observations[k * block_lanes + lane]);
  }
}

void ReplayMemory::act(const Layout& layout, const Block& block, std::size_t step) {
  for (std::size_t lane = 0; lane < round_episodes; ++lane) {
    float* to = row(rounds_ - 1, lane, step) + observations_;
    for (std::size_t k = 0; k < layout.action_rows(); ++k)
      to[k] = static_cast<float>(block.actions[k * block_lanes + lane]);
  }
}

void ReplayMemory::reward(const Layout& layout, const Block& block, std::size_t step) {
  const std::size_t prey = layout.scenario().prey();
  for (std::size_t lane = 0; lane < round_episodes; ++lane) {
    float* to = row(rounds_ - 1, lane, step) + observations_ + actions_;
    to[0] = static_cast<float>(block.rewards[lane]);
    to[1] = static_cast<float>(block.rewards[prey * block_lanes + lane]);
  }
}

ReplayMemory::Transition ReplayMemory::transition(std::size_t i) const {
  const std::size_t held = i / transitions_per_round_;
  const std::size_t rest = i % transitions_per_round_;
  const float* now = row(held, rest / steps_, rest % steps_);  // any place of the ring is a round
  return {now, now + width_};
}

std::vector<float> ReplayMemory::round_actions(std::size_t round) const {
  std::vector<float> numbers;
  numbers.reserve(round_episodes * (steps_ + 1) * actions_);
  for (std::size_t episode = 0; episode < round_episodes; ++episode)
    for (std::size_t step = 0; step <= steps_; ++step) {
      const float* from = row(round, episode, step) + observations_;
      numbers.insert(numbers.end(), from, from + actions_);
    }
  return numbers;
}

}  // namespace folk::mpe
