#include <analysis/beliefs/believing_player.h>
#include <folk/analysis/beliefs/extraction.h>
#include <folk/games/error.h>
#include <folk/strategies/machine_text.h>
#include <games/ended_work.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include "strategies/named.h"

namespace folk {
namespace {

using test::believer;
using test::expect_error;
using test::roster;

std::vector<BeliefRecord> records(const Strategy& policy, const std::vector<Strategy>& opponents,
                                  std::uint64_t rounds = 30) {
  Sampling sampling;
  sampling.criterion = Criterion::finite(rounds);
  sampling.repetitions = 4;
  return record_beliefs(policy, opponents, sampling);
}

/// A player who counts: as tit_for_tat, but it defects in the last round.
class Counting final : public Player {
public:
  void start(const MatchStart& match) override {
    left_ = match.criterion.rounds();
    last_ = Move::C;
  }
  Move move() override { return left_ <= 1 ? Move::D : last_; }
  void observe(Move, Move theirs) override {
    last_ = theirs;
    --left_;
  }
  std::unique_ptr<Player> clone() const override { return std::make_unique<Counting>(*this); }

private:
  std::uint64_t left_ = 0;
  Move last_ = Move::C;
};

Strategy counting() {
  Strategy strategy;
  strategy.name = "counting";
  strategy.deterministic = true;
  strategy.make_player = [] { return std::make_unique<Counting>(); };
  return strategy;
}

TEST(Extraction, FindsTheMachineInAPlayer) {
  const auto opponents = roster("all_c,all_d,per_ccd,random(0.5)");
  for (const char* name : {"tit_for_tat", "pavlov", "tf2t", "spiteful"})
    for (const bool clones : {true, false}) {
      const auto policy = believer(name, "all_c", clones);
      ExtractionOptions options;
      options.depth = 6;
      options.state_prices = {0};
      const auto found = extract_machines(policy, opponents, records(policy, opponents), options);
      ASSERT_EQ(found.size(), 1U);
      const auto whole = minimise(*tabulate(*Registry::standard().make(name).machine, Sense::own_moves_its_own),
                                  Sense::own_moves_its_own);
      EXPECT_EQ(found[0].machine, whole) << name;
      EXPECT_EQ(found[0].wrong, 0U);
      EXPECT_EQ(found[0].built_from, (3U + 4U) * 30U + 127U);
      EXPECT_EQ(found[0].matches.told(), 1);
      EXPECT_EQ(found[0].matches.played(), 1);
      EXPECT_FALSE(found[0].matches.matches[3].equal_played) << "a random opponent cannot be played again";
      for (const auto& match : found[0].matches.matches) EXPECT_FALSE(match.first_difference);
      EXPECT_EQ(read_machines(write_machine(name, found[0].machine), "text")[0].machine, whole);
    }
}

TEST(Extraction, ComparesMoveByMove) {
  const auto policy = believer("tit_for_tat", "all_c");
  const auto opponents = roster("all_c,all_d,per_cd");
  const auto always = *tabulate(*Registry::standard().make("all_c").machine, Sense::own_moves_its_own);
  const auto result = fidelity(always, opponents, records(policy, opponents, 10));
  EXPECT_EQ(result.moves(), 30U);
  EXPECT_EQ(result.matches[0].equal_told, 10U);
  EXPECT_EQ(result.matches[1].equal_told, 1U);
  EXPECT_EQ(result.matches[1].equal_played, 1U);
  EXPECT_EQ(result.matches[1].first_difference, 2U);
  EXPECT_EQ(result.matches[2].first_difference, 3U);
  EXPECT_NEAR(result.told(), (10 + 1 + 6) / 30.0, 1e-12);
}

TEST(Extraction, LastRoundsMayBeIgnored) {
  const auto policy = counting();
  const auto opponents = roster("all_c,all_d,per_ccd");
  const auto matches = records(policy, opponents);
  ExtractionOptions options;
  options.depth = 5;
  options.state_prices = {0};
  options.ignored_last = 1;
  const auto found = extract_machines(policy, opponents, matches, options).front();
  EXPECT_EQ(found.machine.size(), 2U);
  EXPECT_EQ(found.wrong, 0U);
  EXPECT_EQ(found.matches.told(), 88.0 / 90) << "all_d is met with D in the last round, the others with C";
  EXPECT_EQ(found.matches.matches[0].first_difference, 30U);
  options.ignored_last = 0;
  const auto counted = extract_machines(policy, opponents, matches, options).front();
  EXPECT_EQ(counted.matches.told(), 1);
  EXPECT_GT(counted.machine.size(), 2U);
}

TEST(Extraction, OnTwoThreadsIsTheSame) {
  const auto policy = counting();
  const auto opponents = roster("all_c,all_d,per_ccd");
  ExtractionOptions options;
  options.depth = 7;
  const auto one = extract_machines(policy, opponents, records(policy, opponents), options);
  options.threads = 2;
  const auto two = extract_machines(policy, opponents, records(policy, opponents), options);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].machine, two[i].machine);
}

Extraction of_size(std::size_t states, std::uint64_t equal, std::uint64_t wrong) {
  Extraction extraction{Automaton(std::vector<Automaton::Node>(states, {1, {0, 0, 0, 0}}), 0)};
  extraction.matches.matches.push_back({"somebody", 1000, equal, equal});
  extraction.wrong = wrong;
  return extraction;
}

TEST(Extraction, TheReadableMachineIsFaithfulThenSmall) {
  EXPECT_EQ(readable_machine({of_size(40, 1000, 0), of_size(16, 995, 9), of_size(9, 995, 9), of_size(3, 992, 4)}), 2U);
  EXPECT_EQ(readable_machine({of_size(30, 985, 0), of_size(9, 980, 9)}), 0U) << "the limit is doubled below the aim";
  EXPECT_EQ(readable_machine({of_size(30, 985, 0), of_size(9, 980, 9)}, 16, 0.9), 1U);
  EXPECT_EQ(readable_machine({of_size(33, 1000, 0)}), std::nullopt);
}

TEST(Extraction, RefusesWhatItCannotBuildFrom) {
  const auto policy = counting();
  const auto opponents = roster("all_c");
  const auto matches = records(policy, opponents, 8);
  ExtractionOptions options;
  expect_error<UsageError>([&] { extract_machines(policy, opponents, matches, options); }, "depth of 10");
  options.depth = 3;
  options.ignored_last = 8;
  expect_error<UsageError>([&] { extract_machines(policy, opponents, matches, options); }, "leave nothing");
  options.ignored_last = 0;
  expect_error<UsageError>([&] { extract_machines(policy, {}, matches, options); }, "0 opponents");
  auto random = policy;
  random.deterministic = false;
  expect_error<UsageError>([&] { extract_machines(random, opponents, matches, options); },
                           "is not known to be deterministic");
}

TEST(ExtractionThreads, EndsAsItsProgressWishes) {
  const auto policy = believer("pavlov", "all_c");
  const auto opponents = roster("all_d,per_ccd");
  const auto met = records(policy, opponents);
  for (const unsigned threads : {1U, 4U}) {
    ExtractionOptions options;
    options.depth = 5;
    options.threads = threads;
    test::expect_ends([&](const Progress& progress) {
      EXPECT_EQ(extract_machines(policy, opponents, met, options, progress).size(), options.state_prices.size());
    });
  }
}

}  // namespace
}  // namespace folk
