// Training windows: how lessons are cut out of matches and how windows are drawn.

#include <folk/games/error.h>
#include <folk/sct/data/windows.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace folk::sct {
namespace {

constexpr std::size_t many = 40'000;

/// A match whose returns-to-go tell the round: `rounds`, `rounds` - 1, ... 1, all plus `base`.
Lesson lesson(std::size_t rounds, double base = 0) {
  Trajectory trajectory;
  for (std::size_t t = 0; t < rounds; ++t)
    trajectory.add(t % 2 == 0 ? Move::C : Move::D, t % 3 == 0 ? Move::D : Move::C, t + 1 == rounds ? 1 + base : 1);
  return imitation(trajectory);
}

TEST(Observations, TellOfTheLastRounds) {
  const std::vector<std::uint8_t> seen{0, 2, 4, 1};
  std::vector<float> numbers{7};
  append_observations(seen, 2, 4, numbers);
  // The newest first: 4, 2, the start, and before it the start again.
  EXPECT_EQ(numbers, (std::vector<float>{7, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0}));
}

TEST(Windows, RememberWhatIsBeforeThem) {
  const auto whole = lesson(30);
  RandomStream random({1, 2, 3, 4});
  const auto batch = draw_windows({whole}, {.windows = 50, .context = 4, .early = 0, .remembered = 3}, random);
  for (std::size_t i = 0; i < batch.rounds(); ++i) {
    std::vector<float> expected;
    append_observations(whole.observations, static_cast<std::size_t>(batch.timesteps[i]), 3, expected);
    const auto begin = batch.observations.begin() + static_cast<std::ptrdiff_t>(i * expected.size());
    ASSERT_EQ(std::vector<float>(begin, begin + static_cast<std::ptrdiff_t>(expected.size())), expected);
  }
}

TEST(Windows, TellTheFirstRoundsApartByTheirTime) {
  RandomStream random({1, 2, 3, 4});
  const auto whole = lesson(9);
  for (const std::size_t rows : {1U, 4U, 9U, 20U}) {
    const auto batch = draw_windows({whole}, {.windows = 3, .context = 9, .time_rows = rows}, random);
    const Architecture network{.time_rows = rows};
    for (std::size_t i = 0; i < batch.rounds(); ++i) {
      EXPECT_EQ(batch.timesteps[i],
                std::min<std::int32_t>(static_cast<std::int32_t>(i % 9), static_cast<std::int32_t>(rows) - 1));
      EXPECT_EQ(batch.timesteps[i], network.time_row(i % 9)) << "as players have it";
    }
  }
}

TEST(Windows, HideReturnsAndShowWhatIsToBeBelieved) {
  auto whole = lesson(6);
  whole.beliefs = {0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 1};
  RandomStream random({1, 2, 3, 4});
  const auto batch = draw_windows({whole, lesson(6)},
                                  {.windows = 40, .context = 6, .shows_return = false, .return_jitter = 3}, random);
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < batch.rounds(); ++i) {
    EXPECT_EQ(batch.returns[i], 0);
    const auto t = static_cast<std::size_t>(batch.timesteps[i]);
    const float cooperates = batch.belief_targets[2 * i];
    EXPECT_EQ(batch.belief_targets[2 * i + 1], 1 - cooperates);
    if (cooperates == whole.beliefs[t])
      ++labelled;
    else
      EXPECT_EQ(cooperates, 1.0F - static_cast<float>(whole.opponent[t]));
  }
  EXPECT_GT(labelled, 40U);
}

/// Calls look(first round in the batch, rounds) for each window.
template <class Look>
void for_windows(const Batch<float>& batch, Look&& look) {
  std::size_t first = 0;
  for (const auto rounds : batch.window_rounds) {
    look(first, rounds);
    first += rounds;
  }
  EXPECT_EQ(first, batch.rounds());
}

/// Expects a count of `size` draws to lie within five standard deviations of a share.
void expect_share(double count, double size, double share) {
  EXPECT_NEAR(count, share * size, 5 * std::sqrt(size * share * (1 - share)));
}

TEST(Imitation, IsTheMatchAsItsPlayerSawIt) {
  Trajectory trajectory;
  trajectory.add(Move::C, Move::D, 0);
  trajectory.add(Move::D, Move::C, 5);
  trajectory.add(Move::D, Move::D, 1);
  const auto seen = imitation(trajectory);
  EXPECT_EQ(seen.rounds(), 3U);
  EXPECT_EQ(seen.observations, (std::vector<std::uint8_t>{0, 2, 3}));
  EXPECT_EQ(seen.own, (std::vector<std::uint8_t>{0, 1, 1}));
  EXPECT_EQ(seen.opponent, (std::vector<std::uint8_t>{1, 0, 1}));
  EXPECT_EQ(seen.wanted, seen.own);
  EXPECT_EQ(seen.weights, (std::vector<float>{1, 1, 1}));
  EXPECT_EQ(seen.returns, (std::vector<float>{6, 6, 1}));
}

TEST(Windows, HoldTheRoundsOfTheirLessonFromTheirStartOn) {
  auto whole = lesson(30);
  for (std::size_t t = 0; t < 30; ++t) {
    whole.wanted[t] = t % 5 == 0;
    whole.weights[t] = static_cast<float>(t);
  }
  RandomStream random({1, 2, 3, 4});
  const auto batch = draw_windows({whole}, {.windows = 300, .context = 7, .early = 0.3, .return_scale = 10}, random);
  ASSERT_EQ(batch.windows(), 300U);
  for_windows(batch, [&](std::size_t first, std::size_t rounds) {
    ASSERT_EQ(rounds, 7U);
    for (std::size_t i = first; i < first + rounds; ++i) {
      const auto t = static_cast<std::size_t>(batch.timesteps[i]);
      ASSERT_EQ(t, static_cast<std::size_t>(batch.timesteps[first]) + i - first);
      ASSERT_LT(t, 30U);
      EXPECT_FLOAT_EQ(batch.returns[i], whole.returns[t] / 10);
      EXPECT_EQ(batch.own.classes[i], whole.own[t]);
      EXPECT_EQ(batch.opponent.classes[i], whole.opponent[t]);
      EXPECT_EQ(batch.policy_target().classes[i], whole.wanted[t]);
      EXPECT_EQ(batch.action_weights[i], whole.weights[t]);
      for (std::size_t k = 0; k < observation_size; ++k)
        EXPECT_EQ(batch.observations[i * observation_size + k], k == whole.observations[t] ? 1 : 0);
    }
  });
}

TEST(Windows, BeginInRoundOneOrAnywhere) {
  RandomStream random;
  const auto batch = draw_windows({lesson(12)}, {.windows = many, .context = 3, .early = 0.4}, random);
  std::vector<double> starts(10);
  for_windows(batch,
              [&](std::size_t first, std::size_t) { ++starts.at(static_cast<std::size_t>(batch.timesteps[first])); });
  expect_share(starts[0], many, 0.4 + 0.6 / 10);
  for (std::size_t t = 1; t < starts.size(); ++t) expect_share(starts[t], many, 0.6 / 10);
}

TEST(Windows, AreOfAllLessonsAlikeHoweverLong) {
  RandomStream random;
  const std::vector<Lesson> lessons{lesson(2), lesson(9, 100), lesson(40, 200), lesson(3, 300)};
  const auto batch = draw_windows(lessons, {.windows = many, .context = 2, .return_scale = 1}, random);
  std::vector<double> drawn(4);
  for_windows(
      batch, [&](std::size_t first, std::size_t) { ++drawn.at(static_cast<std::size_t>(batch.returns[first] / 100)); });
  for (const double count : drawn) expect_share(count, many, 0.25);
}

TEST(Windows, TakeShortMatchesWhole) {
  RandomStream random;
  const auto batch =
      draw_windows({lesson(3), lesson(5), lesson(1)}, {.windows = 200, .context = 4, .early = 0}, random);
  std::vector<std::size_t> lengths(5);
  for_windows(batch, [&](std::size_t first, std::size_t rounds) {
    ++lengths.at(rounds);
    if (rounds < 4) {
      EXPECT_EQ(batch.timesteps[first], 0);
    }
  });
  EXPECT_EQ(lengths[0] + lengths[2], 0U);
  EXPECT_GT(lengths[1], 0U);
  EXPECT_GT(lengths[3], 0U);
  EXPECT_GT(lengths[4], 0U);
}

TEST(Windows, ShiftAllReturnsOfAWindowByOneNormalNumber) {
  RandomStream random;
  const auto whole = lesson(12);
  const auto batch =
      draw_windows({whole}, {.windows = many, .context = 4, .return_scale = 100, .return_jitter = 5}, random);
  double sum = 0;
  double squares = 0;
  for_windows(batch, [&](std::size_t first, std::size_t rounds) {
    const auto shift = [&](std::size_t i) {
      return 100 * static_cast<double>(batch.returns[i]) -
             static_cast<double>(whole.returns[static_cast<std::size_t>(batch.timesteps[i])]);
    };
    for (std::size_t i = first + 1; i < first + rounds; ++i) ASSERT_NEAR(shift(i), shift(first), 1e-4);
    sum += shift(first);
    squares += shift(first) * shift(first);
  });
  const double size = many;
  EXPECT_NEAR(sum / size, 0, 5 * 5 / std::sqrt(size));
  EXPECT_NEAR(squares / size, 25, 5 * 25 * std::sqrt(2 / size));
}

TEST(Windows, DependOnTheRandomKeyAlone) {
  const std::vector<Lesson> lessons{lesson(12), lesson(30)};
  const auto draw = [&](std::uint64_t repetition) {
    RandomStream random({1, repetition, 0, 17});
    return draw_windows(lessons, {.return_jitter = 3}, random).returns;
  };
  EXPECT_EQ(draw(1), draw(1));
  EXPECT_NE(draw(1), draw(2));
}

TEST(Windows, OfNothingAreRefused) {
  RandomStream random;
  test::expect_error<UsageError>([&] { draw_windows({}, {}, random); }, "nothing to learn from");
}

}  // namespace
}  // namespace folk::sct
