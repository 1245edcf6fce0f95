#include "analysis/play/naive.h"

#include <folk/analysis/replies/bayes_reply.h>
#include <folk/analysis/replies/posterior.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <memory>

namespace folk {
namespace {

constexpr std::array<double, 4> payoffs{3, 0, 5, 1};

TEST(Posterior, FollowsBayesRule) {
  Posterior posterior(Registry::standard().roster("random(0.25),random(0.75),all_c"));
  EXPECT_DOUBLE_EQ(posterior.cooperation(), (0.25 + 0.75 + 1) / 3);
  posterior.observe(Move::C, Move::C);
  EXPECT_DOUBLE_EQ(posterior.cooperation(), (0.25 * 0.25 + 0.75 * 0.75 + 1) / (0.25 + 0.75 + 1));
  posterior.observe(Move::D, Move::D);
  // all_c is out; what it saw before still counts.
  EXPECT_DOUBLE_EQ(posterior.cooperation(), 0.5);
  posterior.reset();
  EXPECT_DOUBLE_EQ(posterior.cooperation(), 2.0 / 3);
}

TEST(Posterior, KnowsWhenNobodyIsLeft) {
  Posterior posterior(Registry::standard().roster("all_c,tit_for_tat"));
  posterior.observe(Move::C, Move::C);
  EXPECT_TRUE(posterior.possible());
  posterior.observe(Move::C, Move::D);
  EXPECT_FALSE(posterior.possible());
}

TEST(Posterior, WeighsLaterRoundsLess) {
  const Posterior posterior(Registry::standard().roster("spiteful"));
  const auto values = posterior.action_values(payoffs, 3, 0.5);
  EXPECT_DOUBLE_EQ(values[0], 3 + 0.5 * 3 + 0.25 * 5);
  EXPECT_DOUBLE_EQ(values[1], 5 + 0.5 * 1 + 0.25 * 1);
}

RC_GTEST_PROP(Posterior, LookingToTheEndIsOptimalPlay, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 0, 0, 0});
  std::vector<Strategy> roster;
  for (std::size_t i = 1 + random() % 4; i > 0; --i) {
    Strategy member;
    member.name = "machine" + std::to_string(i);
    member.machine = std::make_shared<Automaton>(test::random_automaton(random, 5, true));
    roster.push_back(std::move(member));
  }
  const auto rounds = 1 + static_cast<unsigned>(random() % 6);
  const BayesReply reply(roster, {}, rounds);
  Posterior posterior(roster);
  BayesReply::Node node = reply.root();
  for (unsigned left = rounds; node != BayesReply::nowhere; --left) {
    RC_ASSERT(posterior.possible());
    RC_ASSERT(std::abs(posterior.cooperation() - reply.belief(node)) <= 1e-12);
    const auto values = posterior.action_values(payoffs, left, 1);
    const auto exact = reply.action_values(node);
    for (std::size_t m = 0; m < 2; ++m) RC_ASSERT(std::abs(values[m] - exact[m]) <= 1e-9);
    const Move own = move_from_bit(static_cast<unsigned>(random() % 2));
    const Move theirs = random.chance(reply.belief(node)) ? Move::C : Move::D;
    posterior.observe(own, theirs);
    node = reply.next(node, own, theirs);
  }
}

TEST(Posterior, RefusesWhatCannotBeLearntAbout) {
  EXPECT_THROW(Posterior(std::vector<Strategy>{}), UsageError);
  EXPECT_THROW(Posterior(Registry::standard().roster("exec:\"cat\"")), UsageError);
}

}  // namespace
}  // namespace folk
