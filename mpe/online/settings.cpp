#include <folk/games/error.h>
#include <folk/mpe/network/setting_ranges.h>
#include <folk/mpe/online/settings.h>

namespace folk::mpe {

void require_sound(const OnlineSettings& settings) {
  require_count("hidden", settings.hidden, 1, 4096);
  require_number("learning-rate", settings.learning_rate, 1e-9, 1);
  require_number("final-learning-rate", settings.final_learning_rate, 0, settings.learning_rate);
  require_number("discount", settings.discount, 0, 0.99999);
  require_count("batch", settings.batch, 1, 1 << 20);
  require_count("memory", settings.memory, 1600, 100'000'000);
  require_count("first-update", settings.first_update, 0, 100'000'000);
  require_count("update-every", settings.update_every, 1, 1'000'000);
  require_number("averaging", settings.averaging, 1e-9, 1);
  require_number("clip", settings.clip, 1e-9, 1e9);
  require_number("action-penalty", settings.action_penalty, 0, 1e3);
  require_number("exploration", settings.exploration, 0, 10);
  require_number("final-exploration", settings.final_exploration, 0, 10);
  require_number("target-noise", settings.target_noise, 0, 10);
  require_number("target-noise-clip", settings.target_noise_clip, 0, 10);
  require_count("episodes", settings.episodes, 1, 1'000'000'000);
  require_count("evaluate-every", settings.evaluate_every, 1, 1'000'000'000);
  require_count("evaluation-episodes", settings.evaluation_episodes, 1, 1'000'000);
}

std::string_view to_string(Algorithm algorithm) { return algorithm == Algorithm::matd3 ? "matd3" : "maddpg"; }

std::string_view to_string(Critic critic) { return critic == Critic::centralised ? "centralised" : "independent"; }

}  // namespace folk::mpe
