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

std::vector<TargetScore> validate(const Policy& policy, const std::vector<double>& targets,
                                  const std::vector<Strategy>& roster, const std::vector<Strategy>& held_out,
                                  const Sampling& sampling, const Progress& progress) {
  if (held_out.empty()) return validate(policy, targets, roster, sampling, progress);
  const double part = static_cast<double>(roster.size()) / static_cast<double>(roster.size() + held_out.size());
  auto scores = validate(policy, targets, roster, sampling, progress.part(0, part));
  const auto others = validate(policy, targets, held_out, sampling, progress.part(part, 1));
  for (std::size_t i = 0; i < scores.size(); ++i) scores[i].held_out = {others[i].total, others[i].accuracy};
  return scores;
}

RosterScore play_policy(const Policy& policy, const std::vector<Strategy>& roster, const Sampling& sampling,
                        const Progress& progress) {
  return play_roster({transformer("policy", std::make_shared<const Mind>(policy))}, roster, sampling, progress).front();
}

}  // namespace folk::sct
