#include <folk/games/error.h>
#include <folk/sct/data/windows.h>

#include <algorithm>

namespace folk::sct {
namespace {

std::size_t below(std::size_t bound, RandomStream& random) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(bound));
}

void add_round(const Lesson& lesson, std::size_t t, float shift, float scale, Batch<float>& batch) {
  batch.returns.push_back((lesson.returns[t] + shift) / scale);
  for (std::size_t k = 0; k < observation_size; ++k)
    batch.observations.push_back(k == lesson.observations[t] ? 1.0F : 0.0F);
  batch.timesteps.push_back(static_cast<std::int32_t>(t));
  batch.opponent.classes.push_back(lesson.opponent[t]);
  batch.own.classes.push_back(lesson.own[t]);
  batch.wanted.classes.push_back(lesson.wanted[t]);
  batch.action_weights.push_back(lesson.weights[t]);
}

}  // namespace

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
    for (std::size_t t = start; t < start + length; ++t)
      add_round(lesson, t, shift, static_cast<float>(settings.return_scale), batch);
    batch.window_rounds.push_back(length);
  }
  return batch;
}

}  // namespace folk::sct
