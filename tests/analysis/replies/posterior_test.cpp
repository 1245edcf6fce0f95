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
  Posterior posterior(equal_prior(Registry::standard().roster("random(0.25),random(0.75),all_c")));
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
  Posterior posterior(equal_prior(Registry::standard().roster("all_c,tit_for_tat")));
  posterior.observe(Move::C, Move::C);
  EXPECT_TRUE(posterior.possible());
  posterior.observe(Move::C, Move::D);
  EXPECT_FALSE(posterior.possible());
}

TEST(Posterior, WeighsLaterRoundsLess) {
  const Posterior posterior(equal_prior(Registry::standard().roster("spiteful")));
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
  Posterior posterior(equal_prior(roster));
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

/// A machine whose every move slips.
class Slipping final : public Machine {
public:
  Slipping(std::shared_ptr<const Machine> machine, double slip)
      : machine_(std::move(machine)),
        slip_(slip) {}
  State start() const override { return machine_->start(); }
  double cooperation(State state) const override { return slip_ + (1 - 2 * slip_) * machine_->cooperation(state); }
  State next(State state, Move own, Move theirs) const override { return machine_->next(state, own, theirs); }

private:
  std::shared_ptr<const Machine> machine_;
  double slip_;
};

/// A class as one against the list of all its members, the weights of machines beside it, and moves that slip.
RC_GTEST_PROP(Posterior, OfAClassIsThatOfItsMembers, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 0, 0, 0});
  const auto registry = Registry::standard();
  const std::string name =
      *rc::gen::elementOf(std::vector<std::string>{"memory(1,1)", "memory(0,2)", "memory(2,0)", "memory(1,2)"});
  const double slip = *rc::gen::elementOf(std::vector<double>{0.0, 0.01, 0.2});
  auto as_one = read_prior(registry, "3*tit_for_tat,random(0.3),4*" + name, {});
  RC_ASSERT(as_one.known.size() == 2U);
  RC_ASSERT(as_one.classes.size() == 1U);
  as_one.slip = slip;
  OpponentPrior listed;
  const auto add = [&](const Strategy& strategy, double weight) {
    Strategy slips = strategy;
    slips.machine = std::make_shared<Slipping>(strategy.machine, slip);
    listed.known.push_back({slips, weight});
  };
  for (const auto& [strategy, weight] : as_one.known) add(strategy, weight);
  const auto members = registry.roster(name);
  for (const auto& member : members) add(member, 4.0 / static_cast<double>(members.size()));
  Posterior one(as_one), many(listed);
  const auto& met = members[random() % members.size()].machine;
  State state = met->start();
  for (int round = 0; round < 12; ++round) {
    RC_ASSERT(std::abs(one.cooperation() - many.cooperation()) <= 1e-9);
    const unsigned depth = 1 + static_cast<unsigned>(random() % 3);
    const auto a = one.action_values(payoffs, depth, 0.9), b = many.action_values(payoffs, depth, 0.9);
    RC_ASSERT(std::abs(a[0] - b[0]) <= 1e-8);
    RC_ASSERT(std::abs(a[1] - b[1]) <= 1e-8);
    const Move own = random.chance(0.5) ? Move::C : Move::D;
    const double p = slip + (1 - 2 * slip) * met->cooperation(state);
    const Move theirs = random.chance(p) ? Move::C : Move::D;
    one.observe(own, theirs);
    many.observe(own, theirs);
    state = met->next(state, theirs, own);
  }
}

TEST(Posterior, TakesWhatIsUnlikelyToLeadWhereTheLikelierMoveDoes) {
  auto prior = equal_prior(Registry::standard().roster("spiteful"));
  prior.slip = 0.01;
  Posterior slips(prior);
  for (int round = 0; round < 3; ++round) slips.observe(Move::C, Move::C);
  const auto all = slips.action_values(payoffs, 2, 1), likely = slips.action_values(payoffs, 2, 1, 0.05);
  // C is answered by C with probability 0.99 or, after a slip of theirs, as well: spiteful looks at the other's moves.
  EXPECT_NEAR(all[1], 0.99 * 5 + 0.01 * 1 + 0.01 * 5 + 0.99 * 1, 1e-12);
  EXPECT_NEAR(likely[1], all[1], 1e-12);
  EXPECT_NEAR(likely[0], 0.99 * 3 + 0.99 * 5 + 0.01 * 1, 1e-12);
}

TEST(OpponentPrior, ReadsWeights) {
  const auto registry = Registry::standard();
  const auto prior = read_prior(registry, "3*sct2025, memory(2,2) ,0.5*memory(1,1),all_d", {});
  ASSERT_EQ(prior.known.size(), 18U);
  EXPECT_DOUBLE_EQ(prior.known[0].weight, 3.0 / 17);
  EXPECT_EQ(prior.known[17].strategy.name, "all_d");
  EXPECT_EQ(prior.known[17].weight, 1);
  ASSERT_EQ(prior.classes.size(), 2U);
  EXPECT_EQ(prior.classes[0].weight, 262144);
  EXPECT_EQ(prior.classes[1].members.name(), "memory(1,1)");
  EXPECT_EQ(prior.classes[1].weight, 0.5);
  EXPECT_TRUE(has_weights("all_d,3*all_c"));
  EXPECT_FALSE(has_weights("all_d,exec:\"echo 3*4\""));
  for (const char* wrong :
       {"*all_d", "0*all_d", "-1*all_d", "nan*all_d", "2*", "2**all_d", "2*nobody", "all_d,all_d", "", "1e9*all_d"})
    EXPECT_THROW(read_prior(registry, wrong, {}), UsageError) << wrong;
}

TEST(Posterior, RefusesWhatCannotBeLearntAbout) {
  EXPECT_THROW(Posterior(OpponentPrior{}), UsageError);
  EXPECT_THROW(equal_prior({}), UsageError);
  EXPECT_THROW(equal_prior(Registry::standard().roster("exec:\"cat\"")), UsageError);
  auto prior = equal_prior(Registry::standard().roster("all_d"));
  for (const double weight : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    prior.known[0].weight = weight;
    EXPECT_THROW(Posterior{prior}, UsageError) << weight;
  }
  prior.known[0].weight = 1;
  for (const double slip : {-0.1, 0.5, std::nan("")}) {
    prior.slip = slip;
    EXPECT_THROW(Posterior{prior}, UsageError) << slip;
  }
}

}  // namespace
}  // namespace folk
