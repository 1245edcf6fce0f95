#pragma once
// Score matrices that tests of evolution share.

#include <folk/analysis/evolution/score_matrix.h>
#include <folk/strategies/registry.h>

#include <memory>
#include <string>
#include <vector>

namespace folk::test {

inline std::shared_ptr<const ScoreMatrix> scores_of(const std::string& roster, const Criterion& criterion) {
  TournamentSettings settings;
  settings.criterion = criterion;
  return std::make_shared<ScoreMatrix>(
      play_tournament(Registry::standard().roster(roster, settings.payoffs), settings));
}

inline std::shared_ptr<const ScoreMatrix> scores_of(const std::string& roster, std::uint64_t rounds = 100) {
  return scores_of(roster, Criterion::finite(rounds));
}

/// Strategies a, b, c... that earn these numbers a round.
inline std::shared_ptr<const ScoreMatrix> table_of(const std::vector<std::vector<Rational>>& rows) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < rows.size(); ++i) names.emplace_back(1, static_cast<char>('a' + i));
  return std::make_shared<ScoreMatrix>(names, rows, 1);
}

}  // namespace folk::test
