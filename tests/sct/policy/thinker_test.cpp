// What is thought at play against what training computes on the same window.

#include <folk/games/error.h>
#include <folk/sct/policy/thinker.h>
#include <folk/sct/training/self_confirming_loss.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>
#include <sct/policy/playing_policy.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk::sct {
namespace {

constexpr double tolerance = 1e-4;

/// A round is over, with some reward.
void play_round(MatchSoFar& so_far, Move own, Move theirs, std::uint8_t believed) {
  add_round(so_far, own, theirs, move_from_bit(believed), 0.1 * static_cast<double>(so_far.own.size() % 4));
}

std::uint8_t likelier(double belief) { return belief >= 0.5 ? 0 : 1; }

/// The window of the last `context` rounds, the present one among them, as training would be given it. `slots` stand in
/// the belief tokens. What is played in the present round is not known yet: the window holds a D, which must not
/// matter.
Batch<float> window(const Architecture& architecture, const MatchSoFar& so_far, std::vector<std::uint8_t> slots) {
  const std::size_t now = so_far.own.size();
  const std::size_t first = now + 1 - std::min(now + 1, architecture.context);
  Batch<float> batch;
  for (std::size_t t = first; t <= now; ++t) {
    batch.returns.push_back(so_far.returns[t]);
    batch.timesteps.push_back(static_cast<std::int32_t>(std::min(t, architecture.time_rows - 1)));
    for (std::size_t back = 0; back < architecture.observation_size / observation_size; ++back)
      for (std::size_t k = 0; k < observation_size; ++k) {
        const std::size_t seen = t >= back ? so_far.observations[t - back] : start_observation;
        batch.observations.push_back(k == seen ? 1.0F : 0.0F);
      }
    batch.opponent.classes.push_back(slots[t]);
    batch.own.classes.push_back(t < now ? so_far.own[t] : 1);
  }
  batch.window_rounds = {now + 1 - first};
  return batch;
}

double first_probability(const Matrix<float>& logits) {
  const auto last = logits.bottomRows(1);
  return 1 / (1 + std::exp(static_cast<double>(last(0, 1) - last(0, 0))));
}

/// The training pass of a mode on a batch: what the heads say of its last round.
Thought training_pass(const Mind& mind, LossMode mode, const Batch<float>& batch) {
  SelfConfirmingLoss<float> loss(mind.network, mode);
  const Chunk<float> chunk{batch, 0, 0, batch.window_rounds};
  loss(mind.policy.parameters.data(), chunk, Denominators<float>(batch), {Dropout(), Dropout()}, nullptr);
  Thought thought;
  if (mode != LossMode::action_only) thought.belief = first_probability(loss.predictions().belief);
  thought.cooperation = first_probability(loss.predictions().action);
  return thought;
}

/// What training would say with `slot` in the present belief token.
Thought expected(const Mind& mind, const MatchSoFar& so_far, std::uint8_t slot) {
  const auto& architecture = mind.policy.architecture;
  const auto mode = mind.policy.training.mode;
  const auto with_present = [&](std::vector<std::uint8_t> past) {
    past.push_back(slot);
    return window(architecture, so_far, std::move(past));
  };
  if (mode != LossMode::selfconf) return training_pass(mind, mode, with_present(so_far.opponent));
  return {training_pass(mind, LossMode::teacher, with_present(so_far.opponent)).belief,
          training_pass(mind, LossMode::teacher, with_present(so_far.beliefs)).cooperation};
}

void expect_near(const Thought& thought, const Thought& expected, std::size_t round) {
  EXPECT_NEAR(thought.belief, expected.belief, tolerance) << "round " << round;
  EXPECT_NEAR(thought.cooperation, expected.cooperation, tolerance) << "round " << round;
}

class ThinkerTest : public ::testing::TestWithParam<test::Training> {
protected:
  Mind mind{test::playing_policy(GetParam(), 6)};
  test::Draw draw{7};
  Move any_move() { return draw.chance(0.5) ? Move::C : Move::D; }
};

/// Well beyond the window and the time table; the own moves are anybody's, as after noise.
TEST_P(ThinkerTest, SaysWhatTrainingComputesOnTheLastRounds) {
  for (int match = 0; match < 3; ++match) {
    Thinker thinker(mind);
    auto so_far = begin_match(3 + match);
    for (std::size_t round = 0; round < 25; ++round) {
      const auto thought = thinker.think(so_far);
      const auto slot = likelier(thought.belief);
      expect_near(thought, expected(mind, so_far, slot), round);
      const auto again = Thinker(mind).think(so_far);
      EXPECT_NEAR(again.belief, thought.belief, 1e-5);
      EXPECT_NEAR(again.cooperation, thought.cooperation, 1e-5);
      play_round(so_far, any_move(), any_move(), slot);
    }
  }
}

TEST_P(ThinkerTest, MayBeAskedTwiceOrNotInEveryRound) {
  Thinker thinker(mind);
  auto so_far = begin_match(4.2);
  for (std::size_t round = 0; round < 25; ++round) {
    for (std::size_t times = draw.between(0, 2); times > 0; --times) {
      const auto thought = thinker.think(so_far);
      expect_near(thought, expected(mind, so_far, likelier(thought.belief)), round);
    }
    play_round(so_far, any_move(), any_move(), round % 3 == 0);
  }
}

TEST_P(ThinkerTest, BelievesWhatItIsForcedTo) {
  Thinker thinker(mind);
  auto so_far = begin_match(4.2);
  double moved = 0;
  for (std::size_t round = 0; round < 12; ++round) {
    std::array<Thought, 2> forced;
    for (std::uint8_t slot = 0; slot < 2; ++slot) {
      forced[slot] = thinker.think(so_far, slot == 0 ? Move::C : Move::D);
      expect_near(forced[slot], expected(mind, so_far, slot), round);
    }
    EXPECT_EQ(forced[0].belief, forced[1].belief) << "what is believed is not what is forced";
    moved += std::abs(forced[0].cooperation - forced[1].cooperation);
    play_round(so_far, any_move(), any_move(), likelier(forced[0].belief));
  }
  if (mind.policy.architecture.readout == Readout::own) {
    EXPECT_EQ(moved, 0) << "the action ignores the belief token";
  } else {
    EXPECT_GT(moved, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Trainings, ThinkerTest, ::testing::ValuesIn(test::trainings),
                         [](const auto& tested) { return std::string(tested.param.name); });

/// As long as the window is not full, the beliefs that were held are those of training's own first pass.
TEST(Selfconf, FeedsItselfWhatItsTrainingFed) {
  const Mind mind(test::playing_policy({"", LossMode::selfconf}, 9));
  const auto context = mind.policy.architecture.context;
  test::Draw draw(8);
  for (int match = 0; match < 10; ++match) {
    Thinker thinker(mind);
    auto so_far = begin_match(match);
    for (std::size_t round = 0; round < context; ++round) {
      const auto thought = thinker.think(so_far);
      auto true_slots = so_far.opponent;
      true_slots.push_back(0);  // unknown; training's own beliefs do not see it
      expect_near(thought,
                  training_pass(mind, LossMode::selfconf, window(mind.policy.architecture, so_far, true_slots)), round);
      play_round(so_far, draw.chance(0.5) ? Move::C : Move::D, draw.chance(0.5) ? Move::C : Move::D,
                 likelier(thought.belief));
    }
  }
}

TEST(MindTest, RefusesPoliciesThatCannotPlay2x2Games) {
  const auto refused = [](auto change, std::string_view part) {
    auto policy = test::playing_policy({});
    change(policy.architecture);
    test::Draw draw(1);
    policy.parameters = test::random_parameters<float>(policy.architecture, draw);
    test::expect_error<UsageError>([&] { Mind mind(policy); }, part);
  };
  refused([](Architecture& a) { a.agents = 2; }, "2 agents");
  refused([](Architecture& a) { a.discrete = false; }, "continuous");
  refused([](Architecture& a) { a.action_size = 3; }, "size 3");
  refused([](Architecture& a) { a.observation_size = 4; }, "observations of size 4");
}

}  // namespace
}  // namespace folk::sct
