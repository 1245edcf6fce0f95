#include <folk/games/error.h>
#include <folk/mpe/online/settings.h>

#include <fmt/format.h>

#include <cmath>

namespace folk::mpe {

void require_sound(const OnlineSettings& settings) {
  const auto within = [](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw UsageError(fmt::format("{} {}: expected a number from {} to {}", name, value, low, high));
  };
  const auto count = [&](const char* name, std::size_t value, std::size_t low, std::size_t high) {
    if (value < low || value > high)
      throw UsageError(fmt::format("{} {}: expected a whole number from {} to {}", name, value, low, high));
  };
  count("hidden", settings.hidden, 1, 4096);
  within("learning-rate", settings.learning_rate, 1e-9, 1);
  within("final-learning-rate", settings.final_learning_rate, 0, settings.learning_rate);
  within("discount", settings.discount, 0, 0.99999);
  count("batch", settings.batch, 1, 1 << 20);
  count("memory", settings.memory, 1600, 100'000'000);
  count("first-update", settings.first_update, 0, 100'000'000);
  count("update-every", settings.update_every, 1, 1'000'000);
  within("averaging", settings.averaging, 1e-9, 1);
  within("clip", settings.clip, 1e-9, 1e9);
  within("action-penalty", settings.action_penalty, 0, 1e3);
  within("exploration", settings.exploration, 0, 10);
  within("final-exploration", settings.final_exploration, 0, 10);
  within("target-noise", settings.target_noise, 0, 10);
  within("target-noise-clip", settings.target_noise_clip, 0, 10);
  count("episodes", settings.episodes, 1, 1'000'000'000);
  count("evaluate-every", settings.evaluate_every, 1, 1'000'000'000);
  count("evaluation-episodes", settings.evaluation_episodes, 1, 1'000'000);
}

std::string_view to_string(Algorithm algorithm) { return algorithm == Algorithm::matd3 ? "matd3" : "maddpg"; }

std::string_view to_string(Critic critic) { return critic == Critic::centralised ? "centralised" : "independent"; }

}  // namespace folk::mpe
