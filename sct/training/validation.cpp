#include <folk/sct/policy/sct_player.h>
#include <folk/sct/training/validation.h>

#include <memory>

namespace folk::sct {

std::optional<std::vector<TargetScore>> validate(const Policy& policy, const std::vector<double>& targets,
                                                 const std::vector<Strategy>& roster, const Sampling& sampling,
                                                 const std::function<bool()>& stopped) {
  const auto mind = std::make_shared<const Mind>(policy);
  std::vector<TargetScore> scores;
  for (const double target : targets) {
    if (stopped()) return std::nullopt;
    PlayOptions options;
    options.target = target;
    const auto result = play_roster({transformer("policy", mind, options)}, roster, sampling).front();
    scores.push_back({target, result.total, result.belief_accuracy});
  }
  return scores;
}

RosterScore play_policy(const Policy& policy, const std::vector<Strategy>& roster, const Sampling& sampling) {
  return play_roster({transformer("policy", std::make_shared<const Mind>(policy))}, roster, sampling).front();
}

}  // namespace folk::sct
