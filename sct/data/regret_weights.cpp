#include <folk/games/error.h>
#include <folk/sct/data/regret_weights.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

namespace folk::sct {
namespace {

constexpr double unknown = -std::numeric_limits<double>::infinity();

/// What the best of `matches` earned, by its move in round t. What was earned before t is the same in all of them.
std::array<double, 2> best_by_move(const std::vector<Trajectory>& trajectories, const std::vector<double>& earned,
                                   const std::vector<std::size_t>& matches, std::size_t t) {
  std::array<double, 2> best{unknown, unknown};
  for (const auto i : matches) {
    double& own = best[bit(trajectories[i].own[t])];
    own = std::max(own, earned[i]);
  }
  return best;
}

}  // namespace

void weigh_by_regret(const std::vector<Trajectory>& trajectories, const RegretTemperatures& temperatures,
                     std::vector<Lesson>& lessons) {
  std::vector<double> earned;
  std::map<std::string, double> best_of_all;                   // by opponent
  std::map<std::string, std::vector<std::size_t>> situations;  // by opponent and play so far: its matches
  for (std::size_t i = 0; i < trajectories.size(); ++i) {
    const auto& match = trajectories[i];
    if (match.opponent.empty())
      throw UsageError(
          fmt::format("match {} does not name its opponent, and moves are weighed opponent by opponent", i));
    earned.push_back(std::accumulate(match.rewards.begin(), match.rewards.end(), 0.0));
    const auto place = best_of_all.emplace(match.opponent, unknown).first;
    place->second = std::max(place->second, earned[i]);
    if (match.rounds() > 0) situations[match.opponent + ' '].push_back(i);
  }
  for (std::size_t t = 0; !situations.empty(); ++t) {
    std::map<std::string, std::vector<std::size_t>> next;
    for (const auto& [situation, matches] : situations) {
      const auto [best_c, best_d] = best_by_move(trajectories, earned, matches, t);
      const double best = std::max(best_c, best_d);
      const double best_against = best_of_all.at(trajectories[matches.front()].opponent);
      const double stake = best_c != unknown && best_d != unknown ? std::sqrt(std::abs(best_c - best_d)) : 1;
      const auto likelihood = [&](std::size_t i) { return std::exp((earned[i] - best) / temperatures.move); };
      double sum = 0;
      for (const auto i : matches) sum += likelihood(i);
      const double scale = stake * std::exp((best - best_against) / temperatures.situation) / sum;
      for (const auto i : matches) {
        const auto& match = trajectories[i];
        lessons[i].weights[t] = static_cast<float>(scale * likelihood(i));
        if (t + 1 < match.rounds()) next[situation + to_char(match.own[t]) + to_char(match.theirs[t])].push_back(i);
      }
    }
    situations = std::move(next);
  }
}

}  // namespace folk::sct
