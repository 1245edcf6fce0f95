// Recorded episodes as files: what is read, written, read back and refused.

#include <folk/mpe/evaluation/recording_columns.h>
#include <folk/mpe/evaluation/recording_file.h>
#include <folk/mpe/players/scripted.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "csv.h"
#include "games/expect_error.h"
#include "mpe/evaluation/golden_recordings.h"

namespace folk::mpe {
namespace {

using folk::test::Row;
using testing::golden_data;

bool same(const EpisodeRecord& one, const EpisodeRecord& other) {
  const auto same_row = [](const EpisodeRecord::Row& a, const EpisodeRecord::Row& b) {
    return a.state == b.state && a.actions == b.actions && a.observations == b.observations && a.rewards == b.rewards;
  };
  return one.scenario.name == other.scenario.name && one.number == other.number &&
         one.scenario.episode_steps == other.scenario.episode_steps &&
         std::equal(one.rows.begin(), one.rows.end(), other.rows.begin(), other.rows.end(), same_row);
}

/// Rows of CSV as one text.
std::string text_of(const std::vector<Row>& rows) {
  std::string text;
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) text += row[i] + (i + 1 < row.size() ? "," : "\n");
  return text;
}

std::vector<Row> golden_rows() { return folk::test::read_csv("mpe/tag_14.csv"); }

/// A field of golden_rows() by its row (0: the header) and column.
std::string& field(std::vector<Row>& rows, std::size_t row, const std::string& column) {
  const auto found = std::find(rows[0].begin(), rows[0].end(), column);
  return rows[row][static_cast<std::size_t>(found - rows[0].begin())];
}

void expect_refused(const std::string& text, std::string_view part) {
  test::expect_error<InputFileError>([&] { parse_recording(text, "mine.csv"); }, part);
}

/// The golden episode with another text in one field is refused so.
void expect_refused_field(std::size_t row, const std::string& column, const std::string& value, std::string_view part) {
  auto rows = golden_rows();
  field(rows, row, column) = value;
  expect_refused(text_of(rows), part);
}

TEST(RecordingFile, ReadsWhatTheProgramRecorded) {
  const auto episodes = read_recording(golden_data("tag_14.csv"));
  ASSERT_EQ(episodes.size(), 1U);
  const auto& episode = episodes.front();
  EXPECT_EQ(episode.scenario.name, "simple_tag");
  EXPECT_EQ(episode.number, 14U);
  EXPECT_EQ(episode.predators, "");
  ASSERT_EQ(episode.rows.size(), 26U);
  EXPECT_EQ(episode.scenario.episode_steps, 25U);
  auto rows = golden_rows();
  const auto& row = episode.rows[17];
  const auto number = [&](const char* column) { return std::stod(field(rows, 18, column)); };
  EXPECT_EQ(row.state.positions[2], (Point{number("agent2.px"), number("agent2.py")}));
  EXPECT_EQ(row.state.velocities[3], (Point{number("agent3.vx"), number("agent3.vy")}));
  EXPECT_EQ(row.state.positions[5], (Point{number("landmark1.px"), number("landmark1.py")}));
  EXPECT_EQ(row.actions[1], (Point{number("act1.x"), number("act1.y")}));
  EXPECT_EQ(row.observations[3][13], number("obs3.13"));
  EXPECT_EQ(row.rewards[3], number("rew3"));
}

TEST(RecordingFile, RecognisesTheScenarioByItsColumns) {
  EXPECT_EQ(read_recording(golden_data("world_01.csv")).front().scenario.name, "simple_world");
  EXPECT_EQ(read_recording(golden_data("tag_01.csv"), RewardRule::paper).front().scenario.rewards.rule,
            RewardRule::paper);
}

TEST(RecordingFile, ColumnsMayStandInAnyOrder) {
  auto rows = golden_rows();
  for (auto& row : rows) std::reverse(row.begin(), row.end());
  EXPECT_TRUE(same(parse_recording(text_of(rows), "x").front(), read_recording(golden_data("tag_14.csv")).front()));
}

TEST(RecordingFile, LinesMayEndAsOnWindowsOrNotAtAll) {
  const auto plain = text_of(golden_rows());
  std::string windows;
  for (const char c : plain) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto expected = parse_recording(plain, "x").front();
  EXPECT_TRUE(same(parse_recording(windows, "x").front(), expected));
  EXPECT_TRUE(same(parse_recording(plain.substr(0, plain.size() - 1), "x").front(), expected));
}

TEST(RecordingFile, SeveralEpisodesFollowEachOther) {
  auto rows = golden_rows();
  auto other = golden_rows();
  other.erase(other.begin() + 4, other.end());
  for (std::size_t row = 1; row < other.size(); ++row) {
    field(other, row, "episode") = "3";
    rows.push_back(other[row]);
  }
  const auto episodes = parse_recording(text_of(rows), "x");
  ASSERT_EQ(episodes.size(), 2U);
  EXPECT_EQ(episodes[0].rows.size(), 26U);
  EXPECT_EQ(episodes[1].number, 3U);
  EXPECT_EQ(episodes[1].rows.size(), 3U);
  EXPECT_EQ(episodes[1].scenario.episode_steps, 2U);
}

RC_GTEST_PROP(RecordingFile, OwnEpisodesAreWrittenAndReadBackTheSame, ()) {
  const Layout layout(Scenario::named(*rc::gen::element("simple_tag", "simple_world")));
  std::vector<EpisodeRecord> episodes;
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  for (std::uint64_t number = 0; number < 2; ++number)
    episodes.push_back(record_episode(layout, {lead_pursuit(), random_player()}, seed, number));
  const auto back = parse_recording(recording_text(episodes), "x");
  RC_ASSERT(back.size() == 2);
  RC_ASSERT(same(back[0], episodes[0]) && same(back[1], episodes[1]));
}

TEST(RecordingFile, WritesTheColumnsOfTheGoldenFiles) {
  for (const char* name : {"tag_14.csv", "world_08.csv"}) {
    std::ifstream file(golden_data(name));
    std::string header;
    std::getline(file, header);
    const auto text = recording_text(read_recording(golden_data(name)));
    EXPECT_EQ(text.substr(0, text.find('\n')), header);
    EXPECT_TRUE(same(parse_recording(text, "x").front(), read_recording(golden_data(name)).front()));
  }
}

TEST(RecordingFile, RefusesToWriteWhatIsNoFile) {
  test::expect_error<UsageError>([] { recording_text({}); }, "no episode");
  std::vector<EpisodeRecord> mixed{read_recording(golden_data("tag_14.csv")).front(),
                                   read_recording(golden_data("world_08.csv")).front()};
  test::expect_error<UsageError>([&] { recording_text(mixed); }, "a file for each");
  mixed.pop_back();
  mixed[0].rows[2].rewards.pop_back();
  test::expect_error<UsageError>([&] { recording_text(mixed); }, "not one of simple_tag");
}

TEST(RecordingFile, Headers) {
  expect_refused("", "mine.csv:1: empty");
  expect_refused("hello", "mine.csv:1: expected the names of columns");
  expect_refused(std::string("\x7F\x45\x4C\x46\x00\x01\xFF,\n\n", 10), "mine.csv:1: expected the names of columns");
  auto rows = golden_rows();
  expect_refused(text_of({rows[0]}), "mine.csv:1: no rows");
  for (const char* column : {"episode", "t", "agent0.px", "landmark1.vy", "act3.y", "obs3.13", "rew3"}) {
    auto renamed = rows;
    field(renamed, 0, column) = "mine";
    expect_refused(text_of(renamed), std::string("mine.csv:1: no column '") + column + "'");
    auto twice = rows;
    for (auto& row : twice) row.push_back(row.front());
    twice[0].back() = column;
    expect_refused(text_of(twice), std::string("mine.csv:1: column '") + column + "' twice");
  }
  for (auto& row : rows) row.push_back("0");
  rows[0].back() = "obs3.14";
  expect_refused(text_of(rows), "mine.csv:1: column 'obs3.14' is none of a recorded simple_tag");
}

TEST(RecordingFile, AFileThatWasCutOff) {
  const auto text = text_of(golden_rows());
  expect_refused(text.substr(0, text.size() / 2), "fields, line 1 has 100");
  expect_refused(text + "\n", "mine.csv:28: 1 fields");
  expect_refused(text.substr(0, text.size() - 1) + ",0\n", "mine.csv:27: 101 fields");
  expect_refused(text + text.substr(0, text.find('\n') + 1), "mine.csv:28: episode 'episode'");
}

TEST(RecordingFile, FieldsThatAreNoNumbers) {
  for (const char* value :
       {"", "nan", "NaN", "inf", "-inf", "1e400", "abc", "1.5x", " 1", "1 ", "+1", "0x10", "\"1\"", "1\x01"})
    for (const char* column : {"agent0.px", "act2.y", "obs3.13", "rew0"})
      expect_refused_field(3, column, value, std::string("mine.csv:4: ") + column + " '");
  expect_refused_field(3, "rew0", "nan", "expected a finite number");
  expect_refused_field(26, "obs0.0", "-1e101", "mine.csv:27: obs0.0 -1e+101: expected a number up to 1e+100 in size");
  for (const char* value : {"", "x", "1.5", "-1", "18446744073709551616"}) {
    expect_refused_field(3, "episode", value, "mine.csv:4: episode '");
    expect_refused_field(3, "t", value, "mine.csv:4: t '");
  }
}

TEST(RecordingFile, RowsThatDoNotFollowEachOther) {
  expect_refused_field(1, "t", "1", "mine.csv:2: t 1 of episode 14: expected 0");
  expect_refused_field(5, "t", "3", "mine.csv:6: t 3 of episode 14: expected 4");
  expect_refused_field(5, "episode", "15", "mine.csv:6: t 4 of episode 15: expected 0");
  auto rows = golden_rows();
  rows.erase(rows.begin() + 7);
  expect_refused(text_of(rows), "mine.csv:8: t 7 of episode 14: expected 6");
  rows = golden_rows();
  rows.resize(2);
  expect_refused(text_of(rows), "mine.csv:2: episode 14 ends before its first step");
  rows.push_back(rows[1]);
  field(rows, 2, "episode") = "2";
  expect_refused(text_of(rows), "mine.csv:3: episode 14 ends before its first step");
  rows = golden_rows();
  for (const char* episode : {"2", "14"})
    for (std::size_t row = 1; row < 4; ++row) {
      rows.push_back(golden_rows()[row]);
      field(rows, rows.size() - 1, "episode") = episode;
    }
  expect_refused(text_of(rows), "mine.csv:31: episode 14 again");
}

TEST(RecordingFile, NumbersThatWouldBeLost) {
  expect_refused_field(9, "landmark1.vx", "0.5", "mine.csv:10: landmark1.vx 0.5: expected 0, landmarks stand still");
  expect_refused_field(1, "act3.y", "0.5", "mine.csv:2: act3.y 0.5: expected 0, no action leads to the reset");
}

TEST(RecordingFile, FilesThatAreNotThere) {
  test::expect_error<InputFileError>([] { read_recording("no/such/file.csv"); }, "no/such/file.csv: no such file");
}

TEST(RecordingColumns, AreThoseOfTheLayout) {
  const Scenario tag = Scenario::named("simple_tag");
  const auto columns = recording_columns(tag);
  EXPECT_EQ(columns.size(), 6 * 4 + 8 + 16 * 3 + 14 + 4U);
  const auto count = [&](Quantity quantity) {
    return std::count_if(columns.begin(), columns.end(), [&](const auto& c) { return c.quantity == quantity; });
  };
  EXPECT_EQ(count(Quantity::state), 24);
  EXPECT_EQ(count(Quantity::action), 8);
  EXPECT_EQ(count(Quantity::observation), 62);
  EXPECT_EQ(count(Quantity::reward), 4);
}

}  // namespace
}  // namespace folk::mpe
