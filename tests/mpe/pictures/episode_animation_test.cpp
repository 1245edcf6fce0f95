#include <folk/mpe/pictures/episode_animation.h>
#include <folk/mpe/players/scripted.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/pictures/sample_episode.h"
#include "mpe/pictures/xml_check.h"

namespace folk::mpe {
namespace {

using test::count;
using test::expect_error;
using test::sample_episode;
using test::XmlCheck;

/// All that the first group of a pattern matches.
std::vector<std::string> all(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

TEST(EpisodeAnimation, IsOneWellFormedDocumentThatNeedsNothingElse) {
  const std::string svg = animated_svg(sample_episode());
  EXPECT_EQ(XmlCheck::fault(svg), "");
  for (const char* outside : {"<script", "href", "<style", "<image", "@import", "onload"})
    EXPECT_EQ(count(svg, outside), 0U) << outside;
  EXPECT_EQ(count(svg, "http"), 1U);  // the name of the SVG language, which is no reference
  for (const auto& place : all(svg, "url\\(([^)]*)\\)")) EXPECT_EQ(place.front(), '#');
}

TEST(EpisodeAnimation, HasAllThatMoves) {
  const std::string svg = animated_svg(sample_episode());
  EXPECT_EQ(count(svg, "<g class=\"agent\">"), 4U);
  EXPECT_EQ(count(svg, "<g class=\"trail\""), 4U);
  EXPECT_EQ(count(svg, "attributeName=\"stroke-dashoffset\""), 12U);
  EXPECT_EQ(count(svg, "<animateTransform"), 4U + 2U + 1U);  // agents, counters, the dot on the curve
  // Five steps and six at rest, a quarter of a second each; only the rings flash faster.
  EXPECT_EQ(all(svg, "dur=\"([^\"]*)\"").size(), count(svg, "dur=\"2.75s\"") + count(svg, "dur=\"0.25s\""));
  EXPECT_EQ(count(svg, "dur=\"0.25s\""), 3U);
  EXPECT_EQ(count(svg, "repeatCount=\"indefinite\""), count(svg, "dur="));
}

TEST(EpisodeAnimation, AgentsPassThroughTheirPlacesAndRest) {
  const auto paths = all(animated_svg(sample_episode()),
                         "<g class=\"agent\"><g transform=\"translate\\([^)]*\\)\"><animateTransform "
                         "attributeName=\"transform\" type=\"translate\" dur=\"2.75s\" repeatCount=\"indefinite\" "
                         "values=\"([^\"]*)\"");
  ASSERT_EQ(paths.size(), 4U);
  for (const auto& path : paths) EXPECT_EQ(count(path, ";"), 11U) << path;
  // Predator 2 and the prey stand still; predator 0 is left of the prey, predator 1 right of it.
  const auto places = all(paths[0], "([^;]+)");
  EXPECT_EQ(places[5], places[11]);
  EXPECT_NE(places[3], places[4]);
  for (const std::size_t still : {2U, 3U}) {
    const auto same = all(paths[still], "([^;]+)");
    EXPECT_EQ(std::count(same.begin(), same.end(), same[0]), 12);
  }
  EXPECT_LT(std::stod(places[0]), std::stod(paths[3]));
  EXPECT_GT(std::stod(paths[1]), std::stod(paths[3]));
}

TEST(EpisodeAnimation, BrightTrailsRunAlongTheirPaths) {
  EpisodeRecord record = sample_episode();
  record.rows.resize(2);
  const std::string svg = animated_svg(record);
  const auto dashes = all(svg, "stroke-dasharray=\"([^ ]*) ");
  const auto offsets = all(svg, "stroke-dashoffset\" dur=[^>]*values=\"([^;]*);");
  const auto lasts = all(svg, "stroke-dashoffset=\"([^\"]*)\"");
  ASSERT_EQ(dashes.size(), 12U);
  // Each dash begins just before its path; predator 0 then goes 0.01, the prey stays.
  EXPECT_EQ(offsets, dashes);
  EXPECT_LT(std::stod(lasts[0]), std::stod(dashes[0]));
  EXPECT_EQ(lasts[9], dashes[9]);
  // Over the whole sample predator 0 goes 0.89 units; its longest dash is 0.75.
  const auto whole = all(animated_svg(sample_episode()), "stroke-dash[a-z]*=\"([^ \"]*)");
  EXPECT_NEAR((std::stod(whole[0]) - std::stod(whole[1])) / std::stod(whole[0]), 0.89 / 0.75, 0.002);
}

TEST(EpisodeAnimation, ContactsFlashInTheirSteps) {
  const std::string svg = animated_svg(sample_episode());
  const auto times = all(svg,
                         "<g class=\"contact\" visibility=\"hidden\"><animate attributeName=\"visibility\" "
                         "calcMode=\"discrete\" dur=\"2.75s\" repeatCount=\"indefinite\" "
                         "values=\"hidden;visible;hidden\" keyTimes=\"([^\"]*)\"");
  // Of predator 0 at step 3, of predator 1 and the prey at steps 2 and 3, of eleven.
  EXPECT_EQ(times, (std::vector<std::string>{"0;0.2727;0.3636", "0;0.1818;0.3636", "0;0.1818;0.3636"}));
  EXPECT_EQ(count(svg, "fill=\"none\" stroke=\"#f0e442\""), 3U);  // the rings
  EpisodeRecord record = sample_episode();
  record.rows.resize(4);  // it ends in a contact
  EXPECT_EQ(count(animated_svg(record), "<g class=\"contact\" visibility=\"visible\">"), 3U);
  record.rows.resize(2);
  EXPECT_EQ(count(animated_svg(record), "class=\"contact\""), 0U);
}

TEST(EpisodeAnimation, CountsStepsAndReturns) {
  const std::string svg = animated_svg(sample_episode());
  const auto numbers = all(svg, "<text y=\"[^\"]*\">([^<]*)</text>");
  EXPECT_EQ(numbers,
            (std::vector<std::string>{"0", "1", "2", "3", "4", "5", "0.0", "-1.0", "9.0", "29.0", "28.0", "27.0"}));
  // Each is shown for a step, the last also at rest.
  const auto jumps = all(svg, "calcMode=\"discrete\" dur=\"2.75s\" repeatCount=\"indefinite\" values=\"(\\d[^\"]*)\"");
  ASSERT_EQ(jumps.size(), 2U);
  for (const auto& values : jumps) {
    const auto places = all(values, "([^;]+)");
    ASSERT_EQ(places.size(), 11U);
    EXPECT_NE(places[4], places[5]);
    EXPECT_EQ(places[5], places[10]);
  }
  EXPECT_EQ(count(svg, ">step (of 5)<"), 1U);
  EXPECT_EQ(count(svg, "a predator's return after 5 steps: 27.0"), 1U);
}

TEST(EpisodeAnimation, NamesAreEscaped) {
  EpisodeRecord record = sample_episode();
  record.predators = "exec:\"a<b&c\"";
  record.prey = "\xff]]>\x01";
  record.scenario.name = "<tag>";
  const std::string svg = animated_svg(record);
  EXPECT_EQ(XmlCheck::fault(svg), "");
  EXPECT_EQ(count(svg, "&lt;tag&gt;: exec:&quot;a&lt;b&amp;c&quot; against ?]]&gt; <"), 2U);
}

TEST(EpisodeAnimation, FarAwayIsShownAtTheEdge) {
  EpisodeRecord record = sample_episode();
  EXPECT_EQ(count(animated_svg(record), "attributeName=\"opacity\" calcMode=\"discrete\""), 0U);
  record.rows[4].state.positions[3] = {1e9, 0.5};
  const std::string svg = animated_svg(record);
  EXPECT_EQ(XmlCheck::fault(svg), "");
  EXPECT_EQ(all(svg,
                "attributeName=\"opacity\" calcMode=\"discrete\" dur=\"2.75s\" repeatCount=\"indefinite\" "
                "values=\"1;0.45;1\" keyTimes=\"([^\"]*)\""),
            std::vector<std::string>{"0;0.3636;0.4545"});
  EXPECT_EQ(count(svg, ">beyond the edge<"), 1U);
}

TEST(EpisodeAnimation, IsSmallHoweverLongTheEpisode) {
  for (const char* name : {"simple_tag", "simple_world"}) {
    Scenario scenario = Scenario::named(name);
    const Layout usual(scenario);
    const auto size = animated_svg(record_episode(usual, {lead_pursuit(), still_player()}, 1, 0)).size();
    EXPECT_LT(size, 30'000U);
    scenario.episode_steps = 1000;
    const Layout layout(scenario);
    const std::string svg = animated_svg(record_episode(layout, {lead_pursuit(), random_player()}, 1, 0));
    EXPECT_LT(svg.size(), 80'000U);
    EXPECT_EQ(XmlCheck::fault(svg), "");
    EXPECT_EQ(count(svg, "<text y="), 2U * 121U);
    EXPECT_EQ(count(svg, ">1000</text>"), 1U);
  }
}

TEST(EpisodeAnimation, OneMomentIsAPictureToo) {
  EpisodeRecord record = sample_episode();
  record.rows.resize(1);
  EXPECT_EQ(XmlCheck::fault(animated_svg(record)), "");
  record.rows.clear();
  expect_error<UsageError>([&] { animated_svg(record); }, "there is no step in it");
}

}  // namespace
}  // namespace folk::mpe
