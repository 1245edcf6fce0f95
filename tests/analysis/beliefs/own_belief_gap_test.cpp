// Notion (c) on players whose beliefs and moves are known, and beside all sequences of moves.

#include <analysis/beliefs/believing_player.h>
#include <folk/analysis/beliefs/own_belief_gap.h>
#include <folk/analysis/replies/bayes_player.h>
#include <folk/games/error.h>
#include <games/ended_work.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace folk {
namespace {

using test::believer;
using test::expect_error;
using test::paths;

constexpr std::array payoffs{3.0, 0.0, 5.0, 1.0};

OwnBeliefGap gap(const Strategy& player, const std::string& opponent, std::uint64_t rounds,
                 const OwnBeliefSearch& search = {}) {
  return own_belief_gaps(player, paths(player, opponent, rounds), search).front().value();
}

/// What the player expects to earn from a round of a path on: `own` first, then its own play.
double expected(const Strategy& strategy, const BeliefMatch& path, std::uint64_t from, const std::vector<Move>& own) {
  const auto player = strategy.new_player();
  player->start({{}, Criterion::finite(path.size()), {}});
  double sum = 0;
  for (std::uint64_t t = 0; t < path.size(); ++t) {
    Move mine = player->move();
    Move theirs = likelier_move(*player->belief());
    if (t < from) {
      mine = path[t].own;
      theirs = path[t].theirs;
    } else {
      if (t - from < own.size()) mine = own[t - from];
      sum += payoffs[Outcome{mine, theirs}.index()];
    }
    player->observe(mine, theirs);
  }
  return sum;
}

/// The largest gain of all sequences of up to `depth` moves from each round on, played to the end.
double brute_force(const Strategy& strategy, const BeliefMatch& path, std::size_t depth) {
  double most = 0;
  for (std::uint64_t from = 0; from < path.size(); ++from) {
    const std::size_t length = std::min(depth, path.size() - from);
    for (unsigned bits = 0; bits < (1U << length); ++bits) {
      std::vector<Move> own;
      for (std::size_t k = 0; k < length; ++k) own.push_back(move_from_bit(bits >> k));
      most = std::max(most, expected(strategy, path, from, own) - expected(strategy, path, from, {}));
    }
  }
  return most;
}

/// all_d earns 5 + 9 of a tit_for_tat; cooperating until the last round earns 27 + 5.
TEST(OwnBeliefGap, OfADefectorWhoBelievesInReciprocity) {
  OwnBeliefSearch search;
  search.depth = 10;
  const auto found = gap(believer("all_d", "tit_for_tat"), "tit_for_tat", 10, search);
  EXPECT_EQ(found.gain, 18);
  EXPECT_EQ(found.round, 1U);
  EXPECT_EQ(found.own_value, 14);
  EXPECT_EQ(found.best_value, 32);
  EXPECT_EQ(found.searched_rounds, 10U);
  std::vector<Move> all_but_last(10, Move::C);
  all_but_last.back() = Move::D;
  EXPECT_EQ(found.own_moves, all_but_last);
  EXPECT_EQ(found.believed, std::vector<Move>(10, Move::C));
}

/// After its own defection, as from round 2: 0 + 5 * 3 by six rounds of cooperation, then own play's 5 + 1 + 1, instead
/// of 9 * 1; from rounds 3 and 4 likewise.
TEST(OwnBeliefGap, SequencesEndAndOwnPlayFollows) {
  const auto found = gap(believer("all_d", "tit_for_tat"), "tit_for_tat", 10);
  EXPECT_EQ(found.gain, 13);
  EXPECT_EQ(found.own_moves, std::vector<Move>(6, Move::C));
}

TEST(OwnBeliefGap, IsZeroForABestReplyToTheBeliefs) {
  for (const char* model : {"all_c", "all_d", "per_cd"})
    for (const char* opponent : {"all_c", "tit_for_tat", "per_ddc"}) {
      const auto found = gap(believer("all_d", model), opponent, 12);
      EXPECT_EQ(found.gain, 0) << model;
      EXPECT_EQ(found.round, 0U);
      EXPECT_TRUE(found.own_moves.empty());
    }
}

/// Cooperation with a tit_for_tat is a best reply but in the last round.
TEST(OwnBeliefGap, IsTheLastDefectionOfACooperator) {
  const auto found = gap(believer("tit_for_tat", "tit_for_tat"), "tit_for_tat", 20);
  EXPECT_EQ(found.gain, 2);
  EXPECT_EQ(found.round, 20U);
  EXPECT_EQ(found.own_moves, std::vector<Move>{Move::D});
  EXPECT_EQ(found.believed, std::vector<Move>{Move::C});
}

TEST(OwnBeliefGap, EqualsBruteForceWhenItSearchesAll) {
  OwnBeliefSearch search;
  search.depth = 7;
  search.beam = 64;
  for (const char* own : {"tit_for_tat", "pavlov", "per_ccd", "spiteful", "mistrust"})
    for (const char* model : {"tit_for_tat", "pavlov", "all_c", "tf2t", "prober", "hard_majo"})
      for (const bool clones : {true, false}) {
        const auto player = believer(own, model, clones);
        for (const auto& path : paths(player, "tit_for_tat,all_d,per_ccd", 7))
          EXPECT_EQ(own_belief_gaps(player, {path}, search).front()->gain, brute_force(player, path, 7))
              << player.name << (clones ? "" : ", told anew");
      }
}

TEST(OwnBeliefGap, IsNoMoreThanBruteForceWithANarrowBeam) {
  OwnBeliefSearch search;
  search.depth = 3;
  double found = 0;
  double all = 0;
  for (const char* own : {"tit_for_tat", "pavlov", "spiteful", "mistrust"})
    for (const char* model : {"tit_for_tat", "pavlov", "tf2t", "prober"}) {
      const auto player = believer(own, model);
      for (const auto& path : paths(player, "tit_for_tat,all_d,per_ccd", 9)) {
        const double gain = own_belief_gaps(player, {path}, search).front()->gain;
        const double most = brute_force(player, path, 3);
        EXPECT_LE(gain, most);
        found += gain;
        all += most;
      }
    }
  EXPECT_GE(found, 0.9 * all);
}

TEST(OwnBeliefGap, TheWitnessEarnsWhatIsSaid) {
  const auto player = believer("pavlov", "tit_for_tat");
  for (const auto& path : paths(player, "all_d,per_ccd,tit_for_tat", 30)) {
    const auto found = *own_belief_gaps(player, {path}, {}).front();
    ASSERT_GT(found.gain, 0);
    EXPECT_EQ(expected(player, path, found.round - 1, found.own_moves), found.best_value);
    EXPECT_EQ(expected(player, path, found.round - 1, {}), found.own_value);
    EXPECT_EQ(found.best_value - found.own_value, found.gain);
    EXPECT_EQ(found.own_moves.size(), found.believed.size());
  }
}

TEST(OwnBeliefGap, InCompanyIsAtLeastThatAlone) {
  const auto player = believer("pavlov", "tit_for_tat");
  const auto all = paths(player, "all_d,per_ccd,tit_for_tat,all_c", 24);
  const auto together = own_belief_gaps(player, all, {});
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(together[i]->gain, own_belief_gaps(player, {all[i]}, {}).front()->gain);
}

TEST(OwnBeliefGap, LooksAtTheAskedRoundsAndStopsInTime) {
  const auto player = believer("all_d", "tit_for_tat");
  OwnBeliefSearch search;
  search.rounds = {10, 9, 9};
  const auto found = gap(player, "tit_for_tat", 10, search);
  EXPECT_EQ(found.searched_rounds, 2U);
  EXPECT_EQ(found.gain, 3) << "0 + 5 instead of 1 + 1";
  search.rounds = {10};
  EXPECT_EQ(gap(player, "tit_for_tat", 10, search).gain, 0);
  search.rounds = {};
  search.most_thoughts = 1;
  EXPECT_EQ(gap(player, "tit_for_tat", 10, search).searched_rounds, 0U);
  search.most_thoughts = 60;
  const auto some = gap(player, "tit_for_tat", 50, search);
  EXPECT_GT(some.searched_rounds, 0U);
  EXPECT_LT(some.searched_rounds, 50U);
}

/// Asking a program for 100 rounds of a path takes 100 thoughts, not 1 + 2 + ... + 100.
TEST(OwnBeliefGap, TellsAPlayerWithoutClonesItsPathOnce) {
  OwnBeliefSearch search;
  search.most_thoughts = 101;
  EXPECT_GT(gap(believer("all_d", "tit_for_tat", false), "tit_for_tat", 100, search).searched_rounds, 0U);
}

/// A Bayes-optimal player may believe wrongly, but not gain where it knows whom it meets.
TEST(OwnBeliefGap, OfABayesPlayerWithOneMemberIsZero) {
  Registry registry = Registry::standard();
  add_bayes(registry);
  for (const char* member : {"tit_for_tat", "pavlov", "tf2t", "spiteful"}) {
    const auto player = registry.make(std::string("bayes(") + member + ")");
    EXPECT_EQ(gap(player, member, 15).gain, 0) << member;
  }
}

TEST(OwnBeliefGap, ThereIsNoneWithoutBeliefs) {
  const auto machine = Registry::standard().make("tit_for_tat");
  EXPECT_FALSE(own_belief_gaps(machine, paths(machine, "all_d", 5), {}).front());
  auto random = believer("all_d", "all_c");
  random.deterministic = false;
  EXPECT_FALSE(own_belief_gaps(random, paths(believer("all_d", "all_c"), "all_d", 5), {}).front());
  EXPECT_TRUE(own_belief_gaps(random, {}, {}).empty());
}

TEST(OwnBeliefGap, RefusesWhatIsOutOfRange) {
  const auto player = believer("all_d", "all_c");
  const auto match = paths(player, "all_d", 5);
  OwnBeliefSearch search;
  search.depth = 0;
  expect_error<UsageError>([&] { own_belief_gaps(player, match, search); }, "depth 0");
  search.depth = 13;
  expect_error<UsageError>([&] { own_belief_gaps(player, match, search); }, "1 to 12");
  search = {};
  search.beam = 0;
  expect_error<UsageError>([&] { own_belief_gaps(player, match, search); }, "beam 0");
  search = {};
  search.rounds = {6};
  expect_error<UsageError>([&] { own_belief_gaps(player, match, search); }, "round 6");
  expect_error<UsageError>([&] { own_belief_gaps(player, {match[0], {}}, {}); }, "one length");
}

TEST(OwnBeliefGapThreads, EndsAsItsProgressWishes) {
  const auto player = believer("tit_for_tat", "all_c");
  const auto met = paths(player, "all_d,per_ccd", 12);
  for (const unsigned threads : {1U, 4U}) {
    OwnBeliefSearch search;
    search.threads = threads;
    test::expect_ends(
        [&](const Progress& progress) { EXPECT_EQ(own_belief_gaps(player, met, search, progress).size(), 2U); });
  }
}

}  // namespace
}  // namespace folk
