#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/sct/training/aggregation.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk::sct {

BayesTeacher::BayesTeacher(const std::vector<Strategy>& roster, const Payoffs& payoffs, std::uint64_t rounds,
                           double target)
    : reply_(roster, payoffs, rounds),
      target_(target) {
  const auto numbers = payoffs.numbers();
  for (std::size_t o = 0; o < 4; ++o) rewards_[o] = static_cast<float>(numbers[o]);
}

Lesson BayesTeacher::label(const Trajectory& trajectory) const {
  Lesson lesson = imitation(trajectory);
  auto node = reply_.root();
  auto asked = static_cast<float>(target_);
  for (std::size_t t = 0; t < trajectory.rounds(); ++t) {
    if (node == BayesReply::nowhere)
      throw UsageError(fmt::format("{} against {}: nobody of the roster plays so in round {}", trajectory.player,
                                   trajectory.opponent, t));
    const auto values = reply_.action_values(node);
    lesson.wanted[t] = static_cast<std::uint8_t>(bit(reply_.best(node)));
    lesson.weights[t] = static_cast<float>(std::min(most_weight, std::abs(values[0] - values[1])));
    lesson.returns[t] = asked;
    asked -= rewards_[Outcome{trajectory.own[t], trajectory.theirs[t]}.index()];
    node = reply_.next(node, trajectory.own[t], trajectory.theirs[t]);
  }
  return lesson;
}

}  // namespace folk::sct
