#pragma once
// Five deterministic strategies to record matches with, and what a player earned in all of them.

#include <folk/sct/data/trajectory.h>
#include <folk/strategies/registry.h>

#include <numeric>
#include <vector>

namespace folk::test {

inline const std::vector<Strategy>& roster() {
  static const auto strategies = Registry::standard().roster("all_c,all_d,tit_for_tat,spiteful,per_ccd");
  return strategies;
}

inline double total(const std::vector<sct::Trajectory>& data) {
  double sum = 0;
  for (const auto& match : data) sum = std::accumulate(match.rewards.begin(), match.rewards.end(), sum);
  return sum;
}

}  // namespace folk::test
