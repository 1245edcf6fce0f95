#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/sct/data/recorded_play.h>
#include <folk/strategies/registry.h>

#include <gtest/gtest.h>
#include <sct/data/small_roster.h>

#include <cmath>

namespace folk::sct {
namespace {

using test::roster;
using test::total;

TEST(RecordedPlay, BestRepliesEarnTheOptimum) {
  const auto data = best_reply_data(roster(), {}, 50);
  double optimum = 0;
  for (const auto& member : roster()) optimum += FiniteBestReply(*member.machine, {}, 50).optimum();
  EXPECT_DOUBLE_EQ(total(data), optimum);
}

TEST(RecordedPlay, SlipsAreThePlayersOwnAndDependOnTheirKeyAlone) {
  const auto player = Registry::standard().make("all_c");
  const auto play = [&](std::uint64_t seed) { return play_and_record(player, roster(), {}, 200, 0.1, 3, seed); };
  const auto data = play(1);
  ASSERT_EQ(data.size(), 3 * roster().size());
  EXPECT_EQ(data, play(1));
  EXPECT_NE(data, play(2));
  EXPECT_NE(data[0], data[1]);
  std::size_t slips = 0;
  for (const auto& match : data)
    for (const Move own : match.own) slips += own == Move::D ? 1U : 0U;
  EXPECT_NEAR(static_cast<double>(slips), 300, 5 * std::sqrt(270.0));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(data[i].theirs, std::vector<Move>(200, Move::C)) << "all_c does not slip";
}

}  // namespace
}  // namespace folk::sct
