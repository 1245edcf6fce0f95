#include <folk/sct/policy/sct_player.h>
#include <folk/sct/training/validation.h>

#include <memory>

namespace folk::sct {

std::vector<TargetScore> validate(const Policy& policy, const std::vector<double>& targets,
                                  const std::vector<Strategy>& roster, const Sampling& sampling,
                                  const Progress& progress) {
  const auto mind = std::make_shared<const Mind>(policy);
  std::vector<TargetScore> scores;
  for (const double target : targets) {
    progress.check();
    const auto part = [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(targets.size()); };
    PlayOptions options;
    options.target = target;
    const auto stage = progress.part(part(scores.size()), part(scores.size() + 1));
    const auto result = play_roster({transformer("policy", mind, options)}, roster, sampling, stage).front();
    scores.push_back({target, result.total, result.belief_accuracy});
  }
  return scores;
}

RosterScore play_policy(const Policy& policy, const std::vector<Strategy>& roster, const Sampling& sampling,
                        const Progress& progress) {
  return play_roster({transformer("policy", std::make_shared<const Mind>(policy))}, roster, sampling, progress).front();
}

}  // namespace folk::sct
