// The transformer under the searches that ask many of its players at once.

#include <folk/analysis/beliefs/extraction.h>
#include <folk/analysis/beliefs/own_belief_gap.h>
#include <folk/sct/policy/policy_file.h>
#include <folk/sct/policy/sct_player.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>
#include <sct/policy/playing_policy.h>

#include <filesystem>
#include <memory>
#include <utility>

namespace folk::sct {
namespace {

const std::vector<Strategy>& believed_roster() {
  static const auto strategies = Registry::standard().roster("all_c,all_d,tit_for_tat,per_ccd");
  return strategies;
}

std::vector<BeliefRecord> records(const Strategy& policy, unsigned threads) {
  Sampling sampling;
  sampling.criterion = Criterion::finite(14);
  sampling.threads = threads;
  return record_beliefs(policy, believed_roster(), sampling);
}

std::vector<BeliefMatch> paths(const Strategy& policy) {
  std::vector<BeliefMatch> matches;
  for (const auto& record : records(policy, 1)) matches.push_back(record.matches.front());
  return matches;
}

/// Passes everything on, but is no player that can be cloned or thinks together.
class Shy final : public Player {
public:
  explicit Shy(std::unique_ptr<Player> player)
      : player_(std::move(player)) {}

  void start(const MatchStart& match) override { player_->start(match); }
  Move move() override { return player_->move(); }
  void observe(Move own, Move theirs) override { player_->observe(own, theirs); }
  std::optional<double> belief() const override { return player_->belief(); }

private:
  std::unique_ptr<Player> player_;
};

void expect_equal(const std::vector<std::optional<OwnBeliefGap>>& a,
                  const std::vector<std::optional<OwnBeliefGap>>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_TRUE(a[i].has_value());
    ASSERT_TRUE(b[i].has_value());
    EXPECT_EQ(a[i]->gain, b[i]->gain);
    EXPECT_EQ(a[i]->round, b[i]->round);
    EXPECT_EQ(a[i]->own_moves, b[i]->own_moves);
    EXPECT_EQ(a[i]->believed, b[i]->believed);
  }
}

TEST(OwnBeliefs, GapIsTheSameOnTwoThreads) {
  for (const auto mode : {LossMode::teacher, LossMode::selfconf}) {
    const auto policy = transformer("sct", test::playing_mind({"", mode}, 3));
    OwnBeliefSearch search;
    search.depth = 3;
    const auto one = own_belief_gaps(policy, paths(policy), search);
    search.threads = 2;
    expect_equal(one, own_belief_gaps(policy, paths(policy), search));
  }
}

TEST(OwnBeliefs, GapIsTheSameForAPlayerWhoIsToldAnew) {
  const auto policy = transformer("sct", test::playing_mind({"", LossMode::selfconf}, 4));
  Strategy shy;
  shy.name = "shy";
  shy.deterministic = true;
  shy.make_player = [policy] { return std::make_unique<Shy>(policy.new_player()); };
  OwnBeliefSearch search;
  search.depth = 3;
  search.most_thoughts = 1'000'000;
  expect_equal(own_belief_gaps(policy, paths(policy), search), own_belief_gaps(shy, paths(policy), search));
}

TEST(OwnBeliefs, ThereIsNoGapWithoutThem) {
  const auto policy = transformer("madt", test::playing_mind({"", LossMode::action_only, Readout::own}));
  for (const auto& gap : own_belief_gaps(policy, paths(policy), {})) EXPECT_FALSE(gap);
}

TEST(OwnBeliefs, RecordsAreThoseOfOneThread) {
  const auto policy = transformer("sct", test::playing_mind());
  const auto one = records(policy, 1);
  const auto two = records(policy, 2);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].matches, two[i].matches);
}

TEST(OwnBeliefs, AnAutomatonMadeOnTwoThreadsPlaysAsThePolicy) {
  const auto policy = transformer("sct", test::playing_mind({}, 2));
  ExtractionOptions options;
  options.depth = 5;
  options.state_prices = {0, 4};
  options.threads = 2;
  const auto found = extract_machines(policy, believed_roster(), records(policy, 2), options);
  EXPECT_EQ(found[0].wrong, 0U);
  EXPECT_EQ(found[0].matches.played(), 1);
  EXPECT_LE(found[1].machine.size(), found[0].machine.size());
  options.threads = 1;
  EXPECT_EQ(found[1].machine, extract_machines(policy, believed_roster(), records(policy, 1), options)[1].machine);
}

TEST(OwnBeliefs, TheAutomatonOfSctPlaysItsMatchesAsItDoes) {
  const auto mind =
      std::make_shared<const Mind>(read_policy(std::filesystem::path(FOLK_SOURCE_DIR) / "data/policies/sct.bin"));
  const auto policy = transformer("sct", mind);
  const auto opponents = Registry::standard().roster("sct2025");
  Sampling sampling;
  sampling.threads = 2;
  ExtractionOptions options;
  options.depth = 6;
  options.threads = 2;
  const auto found = extract_machines(policy, opponents, record_beliefs(policy, opponents, sampling), options);
  const auto place = readable_machine(found);
  ASSERT_TRUE(place.has_value());
  EXPECT_GE(*found[*place].matches.played(), 0.99);
  EXPECT_GE(found[*place].matches.told(), 0.99);
  EXPECT_LE(found[*place].machine.size(), 16U);
}

}  // namespace
}  // namespace folk::sct
