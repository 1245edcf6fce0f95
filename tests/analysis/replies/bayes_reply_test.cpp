#include "analysis/play/naive.h"

#include <folk/analysis/replies/bayes_reply.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace folk {
namespace {

using History = std::vector<Outcome>;

/// Where a machine stands after this play, and whether it would have played so.
struct Replayed {
  State state;
  bool consistent = true;
};

Replayed replayed(const Machine& machine, const History& history) {
  Replayed found{machine.start()};
  for (const auto& [own, theirs] : history) {
    found.consistent = found.consistent && move_of(machine, found.state) == theirs;
    found.state = machine.next(found.state, theirs, own);
  }
  return found;
}

/// A roster with whole weights, and Bayes-optimal play by a walk through all histories.
struct Plain {
  std::vector<Strategy> roster;
  std::vector<double> weights;
  Payoffs payoffs;
  unsigned rounds;

  /// Weight of the members that are consistent, and of those that play C next.
  std::array<double, 2> consistent(const History& history) const {
    std::array<double, 2> found{};
    for (std::size_t i = 0; i < roster.size(); ++i) {
      const auto [state, fits] = replayed(*roster[i].machine, history);
      if (!fits) continue;
      found[0] += weights[i];
      if (move_of(*roster[i].machine, state) == Move::C) found[1] += weights[i];
    }
    return found;
  }

  /// Sum over the consistent members of weight times total from here on, after one's own move now.
  double total(const History& history, Move own) const {
    const auto [all, cooperating] = consistent(history);
    double sum = 0;
    for (const Move theirs : {Move::C, Move::D}) {
      const double weight = theirs == Move::C ? cooperating : all - cooperating;
      if (weight == 0) continue;
      sum += weight * to_double(payoffs.by_outcome()[Outcome{own, theirs}.index()]);
      History longer = history;
      longer.push_back({own, theirs});
      if (longer.size() < rounds) sum += std::max(total(longer, Move::C), total(longer, Move::D));
    }
    return sum;
  }
};

/// What the reply earns against one machine, following its best moves.
double earned(const BayesReply& reply, const Machine& opponent, const Payoffs& payoffs, std::uint64_t rounds) {
  double total = 0;
  State state = opponent.start();
  BayesReply::Node node = reply.root();
  for (std::uint64_t t = 0; t < rounds; ++t) {
    const Move own = reply.best(node);
    const Move theirs = move_of(opponent, state);
    total += to_double(payoffs.by_outcome()[Outcome{own, theirs}.index()]);
    state = opponent.next(state, theirs, own);
    node = reply.next(node, own, theirs);
  }
  EXPECT_EQ(node, BayesReply::nowhere);
  return total;
}

double earned_in_all(const BayesReply& reply, const std::vector<Strategy>& roster, std::uint64_t rounds) {
  double total = 0;
  for (const auto& member : roster) total += earned(reply, *member.machine, {}, rounds);
  return total;
}

Plain random_roster(RandomStream& random) {
  Plain plain;
  const std::size_t members = 1 + random() % 5;
  for (std::size_t i = 0; i < members; ++i)
    plain.roster.push_back(
        {"machine" + std::to_string(i), std::make_shared<Automaton>(test::random_automaton(random, 5, true)), {}});
  for (std::size_t i = 0; i < members; ++i) plain.weights.push_back(static_cast<double>(random() % 4));
  plain.weights[random() % members] = 1;
  if (random() % 2 == 0) plain.weights.assign(members, 1);
  plain.rounds = 1 + static_cast<unsigned>(random() % 6);
  return plain;
}

/// Compares every information state with the walk through its history.
void compare(const BayesReply& reply, const Plain& plain, BayesReply::Node node, const History& history) {
  const auto [all, cooperating] = plain.consistent(history);
  if (all == 0 || history.size() == plain.rounds) {
    RC_ASSERT(node == BayesReply::nowhere);
    return;
  }
  RC_ASSERT(node != BayesReply::nowhere);
  RC_ASSERT(reply.belief(node) == cooperating / all);
  const double c = plain.total(history, Move::C);
  const double d = plain.total(history, Move::D);
  RC_ASSERT(std::abs(reply.action_values(node)[0] - c / all) <= 1e-12);
  RC_ASSERT(std::abs(reply.action_values(node)[1] - d / all) <= 1e-12);
  RC_ASSERT(reply.best(node) == (c >= d ? Move::C : Move::D));
  // Deeper nodes cost little each, but there are 4^rounds of them.
  if (history.size() == 3) return;
  for (const Move own : {Move::C, Move::D})
    for (const Move theirs : {Move::C, Move::D}) {
      History longer = history;
      longer.push_back({own, theirs});
      compare(reply, plain, reply.next(node, own, theirs), longer);
    }
}

RC_GTEST_PROP(BayesReply, EqualsAWalkThroughAllHistories, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 0, 0, 0});
  const Plain plain = random_roster(random);
  const BayesReply reply(plain.roster, plain.payoffs, plain.rounds, plain.weights);
  compare(reply, plain, reply.root(), {});
}

RC_GTEST_PROP(BayesReply, EarnsWhatItSays, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 1, 0, 0});
  const auto roster = random_roster(random).roster;
  const std::uint64_t rounds = 1 + random() % 40;
  const BayesReply reply(roster, {}, rounds);
  RC_ASSERT(reply.value() == earned_in_all(reply, roster, rounds));
}

TEST(BayesReply, Earns5260AgainstTheClassicsAnd5160AgainstSct2025) {
  for (const auto& [name, value] : {std::pair("classics", 5260.0), std::pair("sct2025", 5160.0)}) {
    const auto roster = Registry::standard().roster(name);
    const BayesReply reply(roster, {}, 100);
    EXPECT_EQ(reply.value(), value) << name;
    EXPECT_EQ(earned_in_all(reply, roster, 100), value) << name;
    RecordProperty(name, std::to_string(reply.size()));
  }
}

TEST(BayesReply, KnowsMoreThanOneGuess) {
  const auto roster = Registry::standard().roster("all_c,all_d");
  const BayesReply reply(roster, {}, 3);
  EXPECT_EQ(reply.size(), 5U);  // the first round, then who it is in the second and in the third
  EXPECT_EQ(reply.belief(reply.root()), 0.5);
  EXPECT_EQ(reply.value(), 18);  // 15 + 3
  EXPECT_EQ(reply.action_values(reply.root())[1], 9);
  EXPECT_EQ(reply.action_values(reply.root())[0], (3 + 10 + 0 + 2) / 2.0);
  const auto met_d = reply.next(reply.root(), Move::D, Move::D);
  EXPECT_EQ(reply.belief(met_d), 0);
  EXPECT_EQ(reply.next(met_d, Move::D, Move::C), BayesReply::nowhere);
  EXPECT_EQ(reply.next(BayesReply::nowhere, Move::C, Move::C), BayesReply::nowhere);
}

TEST(BayesReply, WeighsThePrior) {
  const auto roster = Registry::standard().roster("all_c,all_d,tit_for_tat");
  const BayesReply sure(roster, {}, 10, {0, 0, 3});
  EXPECT_EQ(sure.belief(sure.root()), 1);
  EXPECT_EQ(sure.value(), 3 * (9 * 3 + 5));
  // Weights in any unit are the same prior.
  const BayesReply equal(roster, {}, 10);
  const BayesReply thirds(roster, {}, 10, {1 / 3.0, 1 / 3.0, 1 / 3.0});
  EXPECT_EQ(thirds.value(), equal.value());
  const BayesReply twice(roster, {}, 10, {2, 1, 1});
  EXPECT_EQ(twice.belief(twice.root()), 0.75);
}

TEST(BayesReply, PlaysCWherePayoffsOfFractionsTie) {
  const auto roster = Registry::standard().roster("tit_for_tat");
  const BayesReply reply(roster, parse_payoffs("T=0.6,R=0.3,P=0.1,S=0"), 3);
  EXPECT_EQ(reply.action_values(reply.root())[0], reply.action_values(reply.root())[1]);
  EXPECT_EQ(reply.best(reply.root()), Move::C);
}

std::string refusal(const std::string& names, std::uint64_t rounds, std::vector<double> prior = {},
                    std::size_t most = BayesReply::most_nodes) {
  try {
    BayesReply(Registry::standard().roster(names), {}, rounds, std::move(prior), most);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(BayesReply, RefusesByName) {
  EXPECT_NE(refusal("pavlov,gtft(0.3)", 10).find("gtft(0.3) mixes"), std::string::npos);
  EXPECT_NE(refusal("exec:\"cat\"", 10).find("opaque"), std::string::npos);
  EXPECT_NE(refusal("classics", 100, {}, 1000).find("all_c,all_d,tit_for_tat"), std::string::npos);
  EXPECT_NE(refusal("gradual", 1'000'000).find("gradual"), std::string::npos);
  EXPECT_NE(refusal("pavlov", 10, {1, 2}).find("2 weights"), std::string::npos);
  EXPECT_NE(refusal("pavlov,tf2t", 10, {1, -2}).find("-2"), std::string::npos);
  EXPECT_NE(refusal("pavlov,tf2t", 10, {0, 0}).find("all weights"), std::string::npos);
  EXPECT_NE(refusal("pavlov", 0).find("0 rounds"), std::string::npos);
  EXPECT_THROW(BayesReply({}, {}, 10), UsageError);
  // A mixing state that play cannot reach does not count.
  EXPECT_EQ(refusal("gtft(0)", 10), "");
}

}  // namespace
}  // namespace folk
