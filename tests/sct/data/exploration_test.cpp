// Explored matches: each its own draw, played by the rules, labelled with what was right to believe.

#include <folk/games/error.h>
#include <folk/sct/data/exploration.h>
#include <folk/strategies/half.h>
#include <folk/strategies/registry.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace folk::sct {
namespace {

constexpr std::uint64_t rounds = 30;

OpponentPrior prior(const std::string& spec, double slip = 0.002) {
  auto prior = read_prior(Registry::standard(), spec, {});
  prior.slip = slip;
  return prior;
}

bool same(const Lesson& a, const Lesson& b) {
  return a.observations == b.observations && a.opponent == b.opponent && a.own == b.own && a.wanted == b.wanted &&
         a.beliefs == b.beliefs;
}

TEST(ExplorationThreads, AMatchIsTheSameInEveryCompany) {
  const Exploration exploration(prior("3*sct2025,memory(2,2)"), {}, rounds);
  const auto many = exploration.matches(7, 0, 20, 3);
  const auto some = exploration.matches(7, 5, 3, 1);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_TRUE(same(some[i], many[5 + i])) << i;
  EXPECT_FALSE(same(many[0], many[1]));
  EXPECT_FALSE(same(many[0], exploration.matches(8, 0, 1, 1)[0]));
}

TEST(Exploration, IsLabelledByThePosterior) {
  const auto known = prior("3*sct2025,memory(1,2),memory(2,1)");
  const auto matches = Exploration(known, {}, rounds).matches(3, 0, 60, 2);
  std::size_t slips = 0, wanted = 0;
  for (const auto& match : matches) {
    ASSERT_EQ(match.rounds(), rounds);
    Posterior posterior(known);
    std::uint8_t seen = start_observation;
    for (std::size_t t = 0; t < rounds; ++t) {
      EXPECT_EQ(match.observations[t], seen);
      EXPECT_FLOAT_EQ(match.beliefs[t], static_cast<float>(posterior.cooperation()));
      const Move own = match.own[t] == 0 ? Move::C : Move::D, theirs = match.opponent[t] == 0 ? Move::C : Move::D;
      // What the opponent does is what somebody of the prior would: never far from what the labels hold possible.
      EXPECT_GT(theirs == Move::C ? match.beliefs[t] : 1 - match.beliefs[t], 0.001F);
      slips += match.own[t] != match.wanted[t] ? 1U : 0U;
      wanted += match.wanted[t];
      posterior.observe(own, theirs);
      seen = observation_of(own, theirs);
    }
    EXPECT_EQ(match.returns, std::vector<float>(rounds, 0));
    EXPECT_EQ(match.weights, std::vector<float>(rounds, 1));
  }
  const double all = 60.0 * rounds;
  EXPECT_GT(static_cast<double>(slips), 0.1 * all);  // the learner's seat is not always the planner's
  EXPECT_LT(static_cast<double>(slips), 0.6 * all);
  EXPECT_GT(wanted, 0U);
}

/// Whoever is met in a class is of the half that may be trained on. An opponent that does not slip, of memory(1,0),
/// plays by its own moves alone: opening and two answers tell which of its eight members it is.
TEST(Exploration, HasWhimsAlsoAfterALongPeace) {
  const auto matches = Exploration(prior("classics"), {}, 100).matches(5, 0, 400, 2);
  std::size_t matches_with_some = 0, deviations = 0, followed = 0;
  for (const auto& match : matches) {
    const auto deviates = [&](std::size_t t) { return match.own[t] != match.wanted[t]; };
    std::size_t first = 0;
    while (first < 100 && !deviates(first)) ++first;
    if (first < 40 || first == 100) continue;  // peace until round 40, and then none
    ++matches_with_some;
    for (std::size_t t = first; t + 1 < 100; ++t)
      if (deviates(t)) ++deviations, followed += deviates(t + 1) ? 1U : 0U;
  }
  EXPECT_GT(matches_with_some, 20U);
  // Slips stand alone; a whim goes on.
  EXPECT_GT(followed, deviations / 6);
}

TEST(Exploration, MeetsTheTrainedHalfOfAClass) {
  const auto registry = Registry::standard();
  const auto matches = Exploration(prior("memory(1,0)"), {}, rounds).matches(1, 0, 300, 2);
  std::set<std::vector<std::uint8_t>> met, allowed;
  for (const auto& match : matches) met.insert(match.opponent);
  for (const auto& member : registry.roster("half(memory(1,0);trained)")) {
    std::vector<std::uint8_t> moves;
    State state = member.machine->start();
    for (std::uint64_t t = 0; t < rounds; ++t) {
      const Move move = member.machine->cooperation(state) == 1 ? Move::C : Move::D;
      moves.push_back(static_cast<std::uint8_t>(bit(move)));
      state = member.machine->next(state, move, Move::C);
    }
    allowed.insert(moves);
  }
  EXPECT_EQ(met, allowed);
}

TEST(Exploration, RefusesAPriorOfNobody) {
  EXPECT_THROW(Exploration({}, {}, rounds), UsageError);
  EXPECT_THROW(Exploration(prior("all_d", 0.7), {}, rounds), UsageError);
}

}  // namespace
}  // namespace folk::sct
