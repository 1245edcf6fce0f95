#include <folk/analysis/play/sampled_play.h>
#include <folk/sct/policy/roster_play.h>

#include <array>

namespace folk::sct {
namespace {

bool deterministic(const Strategy& strategy) {
  return strategy.machine ? strategy.machine->deterministic() : strategy.deterministic;
}

}  // namespace

std::vector<RosterScore> play_roster(const std::vector<Strategy>& strategies, const std::vector<Strategy>& roster,
                                     const Sampling& sampling, const Progress& progress) {
  std::vector<Contest> contests;
  for (const auto& strategy : strategies)
    for (const auto& opponent : roster)
      contests.push_back({&strategy, &opponent, contests.size(),
                          sampling.noise == 0 && deterministic(strategy) && deterministic(opponent)});
  const auto results = play_sampled(contests, sampling, progress);
  const auto payoffs = sampling.payoffs.numbers();
  std::vector<RosterScore> scores(strategies.size());
  for (std::size_t s = 0; s < strategies.size(); ++s) {
    Guesses guesses;
    for (std::size_t i = 0; i < roster.size(); ++i) {
      const auto& result = results[s * roster.size() + i];
      double score = 0;
      for (std::size_t o = 0; o < 4; ++o) score += payoffs[o] * result.weights[o];
      scores[s].scores.push_back(score);
      scores[s].total += score;
      guesses += result.first_guesses;
    }
    scores[s].belief_accuracy = guesses.accuracy();
  }
  return scores;
}

}  // namespace folk::sct
