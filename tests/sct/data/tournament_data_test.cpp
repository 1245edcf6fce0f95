// The training data of a round robin against the tournament's own figures.

#include <folk/analysis/tournament/tournament.h>
#include <folk/sct/data/tournament_data.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace folk::sct {
namespace {

using Seats = std::pair<std::string, std::string>;

Seats seats(const Trajectory& trajectory) { return {trajectory.player, trajectory.opponent}; }

TEST(TournamentData, OfThe17IsEverySeatOfTheirTournament) {
  const auto roster = Registry::standard().roster("sct2025");
  const auto data = tournament_data(roster, {}, 100);
  EXPECT_EQ(data.size(), 289U);
  std::map<Seats, double> scores;
  for (const auto& trajectory : data) {
    EXPECT_EQ(trajectory.rounds(), 100U);
    EXPECT_EQ(trajectory.theirs.size(), 100U);
    scores[seats(trajectory)] = std::accumulate(trajectory.rewards.begin(), trajectory.rewards.end(), 0.0);
  }
  EXPECT_EQ(scores.size(), 289U);
  const auto tournament = play_tournament(roster);
  for (std::size_t i = 0; i < roster.size(); ++i)
    for (std::size_t j = 0; j < roster.size(); ++j)
      EXPECT_EQ(scores.at({roster[i].name, roster[j].name}), tournament.score(i, j))
          << roster[i].name << " v " << roster[j].name;
}

TEST(TournamentData, HoldsBothViewsOfEveryMatch) {
  const auto data = tournament_data(Registry::standard().roster("sct2025"), {}, 100);
  std::map<Seats, const Trajectory*> views;
  for (const auto& trajectory : data) views[seats(trajectory)] = &trajectory;
  for (const auto& trajectory : data) {
    const auto& other_view = *views.at({trajectory.opponent, trajectory.player});
    EXPECT_EQ(trajectory.own, other_view.theirs);
    EXPECT_EQ(trajectory.theirs, other_view.own);
  }
}

TEST(TournamentData, OfMixersRepeatsByTheSeed) {
  const auto roster = Registry::standard().roster("random(0.5),tit_for_tat");
  const auto data = tournament_data(roster, {}, 20, 3, 5);
  // random v itself: two different views of each match; tit_for_tat v itself: one.
  EXPECT_EQ(data.size(), 3U * (2 + 2 + 1));
  std::set<std::vector<Move>> plays;
  for (const auto& trajectory : data)
    if (seats(trajectory) == Seats{"random(0.5)", "tit_for_tat"}) plays.insert(trajectory.own);
  EXPECT_EQ(plays.size(), 3U);
  EXPECT_EQ(tournament_data(roster, {}, 20, 3, 5), data);
  EXPECT_NE(tournament_data(roster, {}, 20, 3, 6), data);
}

TEST(TournamentData, PaysWhatTheGamePays) {
  const auto payoffs = parse_payoffs("T=9,R=4,P=2,S=1");
  for (const auto& trajectory : tournament_data(Registry::standard().roster("all_c,all_d"), payoffs, 2)) {
    const bool cooperates = trajectory.player == "all_c";
    const bool met_by_c = trajectory.opponent == "all_c";
    const double pay = cooperates ? (met_by_c ? 4 : 1) : (met_by_c ? 9 : 2);
    EXPECT_EQ(trajectory.rewards, (std::vector<double>{pay, pay}));
  }
}

}  // namespace
}  // namespace folk::sct
