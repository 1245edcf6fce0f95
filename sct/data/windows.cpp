#include <folk/games/error.h>
#include <folk/sct/data/windows.h>
#include <folk/sct/network/architecture.h>

#include <algorithm>

namespace folk::sct {
namespace {

std::size_t below(std::size_t bound, RandomStream& random) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(bound));
}

void add_round(const Lesson& lesson, std::size_t t, float shift, const WindowSettings& settings, Batch<float>& batch) {
  batch.returns.push_back(
      settings.shows_return ? (lesson.returns[t] + shift) / static_cast<float>(settings.return_scale) : 0.0F);
  append_observations(lesson.observations, t, settings.remembered, batch.observations);
  batch.timesteps.push_back(time_row(t, settings.time_rows));
  batch.opponent.classes.push_back(lesson.opponent[t]);
  batch.own.classes.push_back(lesson.own[t]);
  batch.wanted.classes.push_back(lesson.wanted[t]);
  batch.action_weights.push_back(lesson.weights[t]);
  const float cooperates = lesson.beliefs.empty() ? 1.0F - static_cast<float>(lesson.opponent[t]) : lesson.beliefs[t];
  batch.belief_targets.push_back(cooperates);
  batch.belief_targets.push_back(1 - cooperates);
}

}  // namespace

void append_observations(std::span<const std::uint8_t> observations, std::size_t present, std::size_t remembered,
                         std::vector<float>& numbers) {
  for (std::size_t back = 0; back < remembered; ++back) {
    const std::uint8_t seen = back <= present ? observations[present - back] : start_observation;
    for (std::size_t k = 0; k < observation_size; ++k) numbers.push_back(k == seen ? 1.0F : 0.0F);
  }
}

Lesson imitation(const Trajectory& trajectory) {
  Lesson lesson;
  double to_go = 0;
  for (const double reward : trajectory.rewards) to_go += reward;
  for (std::size_t t = 0; t < trajectory.rounds(); ++t) {
    lesson.observations.push_back(t == 0 ? start_observation
                                         : observation_of(trajectory.own[t - 1], trajectory.theirs[t - 1]));
    lesson.opponent.push_back(static_cast<std::uint8_t>(bit(trajectory.theirs[t])));
    lesson.own.push_back(static_cast<std::uint8_t>(bit(trajectory.own[t])));
    lesson.weights.push_back(1);
    lesson.returns.push_back(static_cast<float>(to_go));
    to_go -= trajectory.rewards[t];
  }
  lesson.wanted = lesson.own;
  return lesson;
}

Batch<float> draw_windows(const std::vector<Lesson>& lessons, const WindowSettings& settings, RandomStream& random) {
  if (lessons.empty()) throw UsageError("there is nothing to learn from: the data holds no match");
  Batch<float> batch;
  for (std::size_t w = 0; w < settings.windows; ++w) {
    const auto& lesson = lessons[below(lessons.size(), random)];
    const std::size_t length = std::min(settings.context, lesson.rounds());
    const bool early = random.chance(settings.early);
    const std::size_t anywhere = below(lesson.rounds() - length + 1, random);
    const std::size_t start = early ? 0 : anywhere;
    const auto shift = static_cast<float>(settings.return_jitter * random.normal());
    for (std::size_t t = start; t < start + length; ++t) add_round(lesson, t, shift, settings, batch);
    batch.window_rounds.push_back(length);
  }
  return batch;
}

}  // namespace folk::sct
