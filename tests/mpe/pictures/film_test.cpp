#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/pictures/film.h>
#include <folk/mpe/players/scripted.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "games/expect_error.h"
#include "mpe/pictures/sample_episode.h"

namespace folk::mpe {
namespace {

using test::expect_error;
using test::sample_episode;

TEST(Film, HasAFrameARowWithContactsAndReturns) {
  const Film film = film_of(sample_episode(), 100);
  ASSERT_EQ(film.frames.size(), 6U);
  const std::vector<double> returns{0, -1, 9, 29, 28, 27};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(film.frames[i].step, i);
    EXPECT_DOUBLE_EQ(film.frames[i].predators_return, returns[i]);
    EXPECT_EQ(film.frames[i].touching, (std::vector<bool>{i == 3, i == 2 || i == 3, false, i == 2 || i == 3})) << i;
  }
  EXPECT_EQ(film.title, "simple_tag: lead_pursuit against still");
  EXPECT_EQ(film.subtitle, "episode 3 of seed 7 · a predator's return after 5 steps: 27.0");
}

TEST(Film, OfFewerFramesKeepsTheContactsBetweenThem) {
  const Film film = film_of(sample_episode(), 3);
  ASSERT_EQ(film.frames.size(), 3U);
  EXPECT_EQ(film.frames[1].step, 3U);
  EXPECT_EQ(film.frames[2].step, 5U);
  EXPECT_EQ(film.frames[1].touching, (std::vector<bool>{true, true, false, true}));
  EXPECT_EQ(film.frames[2].touching, std::vector<bool>(4, false));
  EXPECT_DOUBLE_EQ(film.frames[1].predators_return, 29);
}

TEST(Film, ContactsAreThoseThatAreRewarded) {
  EpisodeRecord record = sample_episode();
  record.rows[0].state.positions[0] = {0, 0.5};       // an overlap at the reset earns nothing
  record.rows[1].state.positions[0] = {-0.125, 0.5};  // just apart
  const Film film = film_of(record, 100);
  EXPECT_FALSE(film.frames[0].touching[0]);
  EXPECT_FALSE(film.frames[1].touching[0]);
}

TEST(Film, AgreesWithTheScoresOfPlayedEpisodes) {
  for (const char* name : {"simple_tag", "simple_world"}) {
    const Layout layout(Scenario::named(name));
    for (const auto& prey : {still_player(), random_player()}) {
      const Cast cast{lead_pursuit(), prey};
      const auto scores = score_episodes(layout, cast, {1, 0, 4, 1});
      double caught = 0;
      for (std::size_t number = 0; number < scores.size(); ++number) {
        const Film film = film_of(record_episode(layout, cast, 1, number), 100);
        double steps = 0;
        double contacts = 0;
        for (const auto& frame : film.frames) {
          steps += frame.touching[3] ? 1 : 0;
          contacts += static_cast<double>(std::count(frame.touching.begin(), frame.touching.begin() + 3, true));
        }
        EXPECT_EQ(steps, scores[number].caught_steps);
        EXPECT_EQ(contacts, scores[number].contacts);
        EXPECT_NEAR(film.frames.back().predators_return, scores[number].predators, 1e-9);
        caught += steps;
      }
      EXPECT_GT(caught, 0) << name;
    }
  }
}

TEST(Film, SaysWhatIsKnownOfTheEpisode) {
  EpisodeRecord record = sample_episode();
  record.prey.clear();
  EXPECT_EQ(film_of(record, 9).title, "simple_tag: lead_pursuit against unknown");
  record.predators.clear();
  EXPECT_EQ(film_of(record, 9).title, "simple_tag: a recorded episode");
  EXPECT_EQ(film_of(record, 9).subtitle, "episode 3 · a predator's return after 5 steps: 27.0");
  record.predators = "a_very_long_folder/with_a_policy.safetensors";
  EXPECT_EQ(film_of(record, 9).title, "simple_tag: a_very_long_…safetensors against unknown");
}

TEST(Film, RefusesWhatIsNoEpisode) {
  const auto refuse = [](const std::function<void(EpisodeRecord&)>& spoil, const char* why) {
    EpisodeRecord record = sample_episode();
    spoil(record);
    expect_error<UsageError>([&] { film_of(record, 9); }, why);
  };
  refuse([](auto& record) { record.rows.clear(); }, "there is no step in it");
  refuse([](auto& record) { record.rows[2].state.positions.pop_back(); }, "step 2 does not fit the scenario");
  refuse([](auto& record) { record.rows[4].rewards.pop_back(); }, "step 4 does not fit the scenario");
  refuse([](auto& record) { record.scenario = Scenario::named("simple_world"); }, "step 0 does not fit the scenario");
  refuse([](auto& record) { record.scenario.entities.clear(); }, "expected at least one predator");
  refuse([](auto& record) { record.rows[1].state.positions[5].y = NAN; }, "step 1 has a position that is not finite");
  refuse([](auto& record) { record.rows[3].rewards[0] = INFINITY; }, "step 3 has a return that is not finite");
  refuse(
      [](auto& record) { record.rows[1].rewards[0] = record.rows[2].rewards[0] = std::numeric_limits<double>::max(); },
      "step 2 has a return that is not finite");
}

RC_GTEST_PROP(Film, EquallySpacedIsSo, ()) {
  const auto size = *rc::gen::inRange<std::size_t>(1, 2000);
  const auto most = *rc::gen::inRange<std::size_t>(2, 300);
  const auto chosen = equally_spaced(size, most);
  RC_ASSERT(chosen.size() == std::min(size, most));
  RC_ASSERT(chosen.front() == 0U);
  RC_ASSERT(chosen.back() == size - 1);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const double exact =
        static_cast<double>(i) * static_cast<double>(size - 1) / std::max(1.0, static_cast<double>(chosen.size() - 1));
    RC_ASSERT(std::abs(static_cast<double>(chosen[i]) - exact) <= 0.5);
  }
}

TEST(Film, WritesReturnsToATenth) {
  EXPECT_EQ(return_text(231.74), "231.7");
  EXPECT_EQ(return_text(-0.04), "0.0");
  EXPECT_EQ(return_text(-1234567.0), "-1.23e+06");
}

}  // namespace
}  // namespace folk::mpe
