// What the world does, recorded: no change of its behaviour passes unsaid, on any processor and in any build.

#include <folk/analysis/play/signature.h>
#include <folk/games/random.h>
#include <folk/mpe/world/batch.h>

#include <gtest/gtest.h>

#include <cstdint>

namespace folk::mpe {
namespace {

/// Of 1,000 steps of 24 episodes, 25 each, and all that they show on the way.
std::uint64_t signature_of(const char* name, RewardRule rule) {
  const auto scenario = Scenario::named(name, rule);
  Batch batch(scenario, 24);
  RandomStream random({.seed = 310});
  Signature signature;
  for (std::uint64_t t = 0; t < 1000; ++t) {
    if (t % 25 == 0) batch.reset(2310, t);
    for (std::size_t e = 0; e < batch.size(); ++e)
      for (std::size_t agent = 0; agent < scenario.agents(); ++agent) {
        // A power of two: the same product whether it is fused with the sum or not.
        const double x = 4 * (random.uniform() - 0.5);
        batch.set_action(e, agent, {x, 4 * (random.uniform() - 0.5)});
      }
    batch.step();
    const Block block = batch.block(0);
    const auto add = [&](const double* rows, std::size_t count) {
      for (std::size_t row = 0; row < count; ++row)
        for (std::size_t e = 0; e < batch.size(); ++e) signature.add(rows[row * block_lanes + e]);
    };
    add(block.state, batch.layout().state_rows());
    add(block.observations, batch.layout().observation_rows());
    add(block.rewards, batch.layout().reward_rows());
  }
  return signature.value();
}

// Whoever changes these numbers says why the world is another one now.
TEST(WorldSignature, IsTheRecordedOne) {
  EXPECT_EQ(signature_of("simple_tag", RewardRule::program), 16640346423730884540U);
  EXPECT_EQ(signature_of("simple_world", RewardRule::program), 4201232074061945584U);
  EXPECT_EQ(signature_of("simple_tag", RewardRule::paper), 15971052987521950435U);
  EXPECT_EQ(signature_of("simple_world", RewardRule::paper), 11636865774876284776U);
}

}  // namespace
}  // namespace folk::mpe
