#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/data/data_figures.h>
#include <folk/mpe/data/data_set.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <functional>
#include <string>

#include "games/expect_error.h"
#include "mpe/data/small_data_set.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using sct::NpyArray;
using sct::NpyType;
using test::Arrays;
using test::Files;
using test::files_of;
using test::Folder;
using test::parse;
using test::played_arrays;
using test::pursuit_cast;

/// Three episodes of a scenario.
Arrays arrays(const char* scenario = "simple_tag") {
  return played_arrays(Layout(Scenario::named(scenario)), pursuit_cast(), 5, 0, 3);
}

void expect_refusal(const Files& files, const std::string& part, const DataSetRules& rules = {}) {
  expect_error<InputFileError>([&] { parse(files, rules); }, part);
}

/// The refusal of three episodes in which something is changed.
void expect_refusal(const std::function<void(Arrays&)>& change, const std::string& part) {
  Arrays changed = arrays();
  change(changed);
  expect_refusal(files_of(changed, NpyType::float64), part);
}

TEST(DataSet, ReadsWhatNumpyWrites) {
  for (const char* scenario : {"simple_tag", "simple_world"})
    for (const NpyType type : {NpyType::float32, NpyType::float64}) {
      const Arrays played = arrays(scenario);
      const Files files = files_of(played, type);
      const DataSet data = parse(files);
      EXPECT_EQ(data.scenario().name, scenario);
      EXPECT_EQ(data.transitions(), 75U);
      EXPECT_EQ(data.episodes(), 3U);
      EXPECT_EQ(data.record(), std::nullopt);
      for (std::size_t i = 0; i < 4; ++i) {
        const std::string file = std::to_string(i) + ".npy";
        const std::size_t width = data.scenario().observation_size(i);
        std::vector<float> now(width), next(width);
        std::array<float, 2> action{};
        for (std::size_t row = 0; row < 75; ++row) {
          data.observation(i, row, now);
          data.next_observation(i, row, next);
          data.action(i, row, action);
          for (std::size_t k = 0; k < width; ++k) {
            ASSERT_EQ(now[k], static_cast<float>(played.at("obs_" + file).values[row * width + k]));
            ASSERT_EQ(next[k], static_cast<float>(played.at("next_obs_" + file).values[row * width + k]));
          }
          ASSERT_EQ(action[0], static_cast<float>(played.at("acs_" + file).values[2 * row]));
          ASSERT_EQ(action[1], static_cast<float>(played.at("acs_" + file).values[2 * row + 1]));
          ASSERT_EQ(data.reward(i, row), static_cast<float>(played.at("rews_" + file).values[row]));
          ASSERT_FALSE(data.done(i, row));
        }
      }
    }
}

TEST(DataSet, TakesColumnsAndOtherTypesOfDones) {
  Arrays columns = arrays();
  for (std::size_t i = 0; i < 4; ++i) {
    columns["rews_" + std::to_string(i) + ".npy"].shape = {75, 1};
    columns["dones_" + std::to_string(i) + ".npy"].shape = {75, 1};
  }
  columns["dones_2.npy"].values[74] = 1;
  Files files = files_of(columns);
  files["dones_2.npy"] = npy_bytes(columns["dones_2.npy"], NpyType::boolean);
  files["dones_3.npy"] = npy_bytes(columns["dones_3.npy"], NpyType::uint8);
  files["obs_1.npy"] = npy_bytes(columns["obs_1.npy"], NpyType::float64);  // beside next_obs_1 of float32
  const DataSet data = parse(files);
  EXPECT_TRUE(data.done(2, 74));
  EXPECT_FALSE(data.done(2, 73));
  EXPECT_EQ(data.reward(1, 30), static_cast<float>(columns["rews_1.npy"].values[30]));
}

TEST(DataSet, NamesEveryMissingFile) {
  Files files = files_of(arrays());
  files.erase("acs_1.npy");
  expect_refusal(files, "set: 1 of the 20 files of a data set is missing: acs_1.npy; it needs");
  files.erase("next_obs_3.npy");
  expect_refusal(files, "set: 2 of the 20 files of a data set are missing: acs_1.npy, next_obs_3.npy; it needs");
  expect_refusal(Files{}, "20 of the 20 files");
}

TEST(DataSet, RefusesShapesThatDoNotFit) {
  expect_refusal(
      [](Arrays& a) {
        a["obs_0.npy"] = {{3, 5}, std::vector<double>(15)};
      },
      "set/obs_i.npy: rows of (5, 16, 16, 14) numbers are of no scenario: expected simple_tag (16, 16, 16, "
      "14) or simple_world (24, 24, 24, 22)");
  expect_refusal(
      [](Arrays& a) {
        a["acs_2.npy"] = {{75, 5}, std::vector<double>(375)};
      },
      "set/acs_2.npy: shape (75, 5): expected (75, 2), as obs_0.npy has 75 rows of simple_tag");
  expect_refusal(
      [](Arrays& a) {
        a["rews_3.npy"] = {{50}, std::vector<double>(50)};
      },
      "set/rews_3.npy: shape (50): expected (75)");
  expect_refusal([](Arrays& a) { a["dones_0.npy"].shape = {1, 75}; }, "set/dones_0.npy: shape (1, 75): expected (75)");
  expect_refusal([](Arrays& a) { a["next_obs_1.npy"].shape = {75, 4, 4}; }, "set/next_obs_1.npy: shape (75, 4, 4)");
  expect_refusal([](Arrays& a) { a["next_obs_3.npy"] = a["next_obs_2.npy"]; },
                 "set/next_obs_3.npy: shape (75, 16): expected (75, 14)");
  for (const std::size_t rows : {0U, 3U})
    expect_refusal(
        [&](Arrays& a) {
          for (auto& [name, array] : a) {
            const std::size_t width = array.values.size() / array.shape[0];
            array.shape[0] = rows;
            array.values.resize(rows * width);
          }
        },
        rows == 0 ? "set/obs_0.npy: no rows" : "set/obs_0.npy: 3 rows make no whole episodes of 25");
}

TEST(DataSet, RefusesTypesAndOrdersItDoesNotRead) {
  Files files = files_of(arrays());
  files["acs_0.npy"] = npy_bytes({{75, 2}, std::vector<double>(150)}, NpyType::int32);
  expect_refusal(files, "set/acs_0.npy: numbers of type <i4: expected <f4 or <f8");
  files = files_of(arrays());
  auto& bytes = files["obs_1.npy"];
  bytes.replace(bytes.find("False"), 5, "True ");
  expect_refusal(files, "set/obs_1.npy: in Fortran order");
  files = files_of(arrays());
  auto& vector = files["rews_1.npy"];  // of one dimension both orders are the same
  vector.replace(vector.find("False"), 5, "True ");
  EXPECT_EQ(parse(files).transitions(), 75U);
  files["dones_3.npy"].resize(200);
  expect_refusal(files, "set/dones_3.npy: 72 bytes of numbers, but shape (75) of <f4 asks for 300");
  files["dones_3.npy"] = "garbage";
  expect_refusal(files, "set/dones_3.npy: no .npy file");
}

TEST(DataSet, RefusesNumbersThatAreNone) {
  expect_refusal([](Arrays& a) { a["obs_2.npy"].values[16 * 30 + 4] = std::nan(""); },
                 "set/obs_2.npy: nan at [30, 4]: expected a finite number");
  expect_refusal([](Arrays& a) { a["rews_0.npy"].values[74] = -HUGE_VAL; }, "set/rews_0.npy: -inf at [74]: expected");
  expect_refusal([](Arrays& a) { a["acs_3.npy"].values[1] = 1e200; }, "set/acs_3.npy: 1e+200 at [0, 1]: expected");
  expect_refusal([](Arrays& a) { a["dones_1.npy"].values[7] = 0.5; }, "set/dones_1.npy: 0.5 at [7]: expected 0 or 1");
  expect_refusal([](Arrays& a) { a["next_obs_3.npy"].values[14 * 75 - 1] = HUGE_VAL; },
                 "set/next_obs_3.npy: inf at [74, 13]: expected");
}

TEST(DataSet, RefusesRowsOutOfOrder) {
  const std::string same = "though both are of one episode of 25 steps";
  expect_refusal([](Arrays& a) { a["next_obs_1.npy"].values[16 * 37 + 15] += 1e-3; },
                 "set/next_obs_1.npy: row 37 is not row 38 of obs_1.npy, " + same);
  expect_refusal(
      [](Arrays& a) {
        a["obs_3.npy"].values[0] += 1;
        a["obs_3.npy"].values[14] += 1;
      },
      "set/next_obs_3.npy: row 0 is not row 1 of obs_3.npy, " + same);
  // What the last row of an episode, and of all, leads to is nobody's next observation.
  Arrays ends = arrays();
  ends["next_obs_0.npy"].values[16 * 24] += 1;
  ends["next_obs_0.npy"].values[16 * 74] += 1;
  EXPECT_EQ(parse(files_of(ends)).episodes(), 3U);
}

/// Some episodes of another length.
Arrays of_length(std::size_t steps, std::size_t episodes) {
  Scenario scenario = Scenario::named("simple_tag");
  scenario.episode_steps = steps;
  return played_arrays(Layout(scenario), pursuit_cast(), 5, 0, episodes);
}

TEST(DataSet, RefusesEpisodesOfAnotherLength) {
  expect_refusal(files_of(of_length(20, 5)), "next_obs_0.npy: row 19 is not row 20 of obs_0.npy");
  expect_refusal(files_of(of_length(50, 2)),
                 "next_obs_0.npy: row 24 is row 25 of obs_0.npy: an episode goes on beyond 25 steps");
  expect_refusal(files_of(of_length(30, 1)), "obs_0.npy: 30 rows make no whole episodes of 25");
  // Where nothing moves, one row is as good as the next.
  Arrays zeros = arrays();
  for (auto& [name, array] : zeros) std::fill(array.values.begin(), array.values.end(), 0);
  EXPECT_EQ(parse(files_of(zeros)).episodes(), 3U);
}

DataRecord record_of(std::size_t steps, std::size_t episodes) {
  Scenario scenario = Scenario::named("simple_tag");
  scenario.episode_steps = steps;
  return {test::description(Layout(scenario), pursuit_cast(), episodes), {}};
}

TEST(DataSet, TakesAnotherLengthWhereBothSaySo) {
  Files files = files_of(of_length(10, 5));
  files["metadata.json"] = metadata_text(record_of(10, 5));
  expect_refusal(files, "set/metadata.json: episodes of 10 steps: expected 25");
  DataSetRules rules;
  rules.any_episode_length = true;
  const DataSet data = parse(files, rules);
  EXPECT_EQ(data.episode_steps(), 10U);
  EXPECT_EQ(data.episodes(), 5U);
  ASSERT_TRUE(data.record());
  EXPECT_EQ(data.record()->description.predators, "lead_pursuit");
  files.erase("metadata.json");
  expect_refusal(files, "row 9 is not row 10", rules);
}

TEST(DataSet, ItsRecordMustFit) {
  Files files = files_of(arrays());
  files["metadata.json"] = metadata_text(record_of(25, 4));
  expect_refusal(files, "metadata.json: 100 transitions are said to be here, but the files have 75 rows");
  auto record = record_of(25, 3);
  record.description.reward_rule = RewardRule::paper;
  files["metadata.json"] = metadata_text(record);
  EXPECT_EQ(parse(files).scenario().rewards.rule, RewardRule::paper);
  record.description.scenario = "simple_world";
  files["metadata.json"] = metadata_text(record);
  expect_refusal(files, "metadata.json: the scenario is said to be 'simple_world', but the files are of simple_tag");
  files["metadata.json"] = "not JSON";
  expect_refusal(files, "set/metadata.json: no JSON object");
  files["metadata.json"] = R"({"source": "somewhere else"})";
  EXPECT_EQ(parse(files).record(), std::nullopt);
  files["metadata.json"] = std::string((1U << 20U) + 1, ' ');
  expect_refusal(files, "set/metadata.json: larger than 1 MiB");
}

TEST(DataSet, OfOneScenarioOnly) {
  DataSetRules rules;
  rules.scenario = "simple_world";
  expect_refusal(files_of(arrays()), "set: a data set of simple_tag: expected one of simple_world", rules);
  EXPECT_EQ(parse(files_of(arrays("simple_world")), rules).scenario().name, "simple_world");
}

TEST(DataSet, TheFirstFaultIsNamedOnAnyNumberOfThreads) {
  Arrays large = played_arrays(Layout(Scenario::named("simple_tag")), pursuit_cast(), 5, 0, 400);
  large["acs_0.npy"].values[2 * 25 * 390] = std::nan("");
  large["rews_3.npy"].values[25 * 130] = std::nan("");
  large["obs_0.npy"].values[16 * 25 * 260] = std::nan("");
  const Files files = files_of(large);
  for (const unsigned threads : {1U, 2U, 3U}) {
    DataSetRules rules;
    rules.threads = threads;
    expect_refusal(files, "rews_3.npy: nan at [3250]", rules);
  }
}

TEST(DataSet, IsAFolder) {
  const Folder folder;
  expect_error<InputFileError>([&] { DataSet::open(folder / "none"); }, "none: no such folder");
  for (const auto& [name, bytes] : files_of(arrays())) write_file(folder / name, bytes);
  const DataSet data = DataSet::open(folder.path());
  EXPECT_EQ(data.transitions(), 75U);
  EXPECT_EQ(data_figures(data).signature, data_figures(parse(files_of(arrays()))).signature);
  write_file(folder / "obs_3.npy", "");
  expect_error<InputFileError>([&] { DataSet::open(folder.path()); }, "obs_3.npy: an empty file");
  std::filesystem::remove(folder / "obs_3.npy");
  std::filesystem::create_directory(folder / "obs_3.npy");
  expect_error<InputFileError>([&] { DataSet::open(folder.path()); }, "obs_3.npy: is no ordinary file");
  std::filesystem::remove(folder / "obs_3.npy");
  ASSERT_EQ(::mkfifo((folder / "obs_3.npy").c_str(), 0600), 0);
  expect_error<InputFileError>([&] { DataSet::open(folder.path()); }, "obs_3.npy: is no ordinary file");
}

TEST(DataFigures, AreTheReturns) {
  const Arrays played = arrays();
  const Files files = files_of(played, NpyType::float64);
  const auto figures = data_figures(parse(files));
  std::vector<double> returns(3);
  for (std::size_t row = 0; row < 75; ++row)
    returns[row / 25] += static_cast<float>(played.at("rews_0.npy").values[row]);
  const double mean = (returns[0] + returns[1] + returns[2]) / 3;
  double squares = 0;
  for (const double value : returns) squares += (value - mean) * (value - mean);
  EXPECT_NEAR(figures.predator.mean, mean, 1e-9);
  EXPECT_NEAR(figures.predator.standard_error.value(), std::sqrt(squares / 2 / 3), 1e-9);
  EXPECT_NE(figures.prey.mean, figures.predator.mean);
  const Files one = files_of(of_length(25, 1));
  EXPECT_EQ(data_figures(parse(one)).predator.standard_error, std::nullopt);
}

TEST(DataFigures, TheSignatureSeesEveryNumber) {
  const Arrays played = arrays();
  const Files files = files_of(played);
  const auto signature = data_figures(parse(files)).signature;
  for (const unsigned threads : {1U, 2U}) EXPECT_EQ(data_figures(parse(files), threads).signature, signature);
  const auto changed = [&](const std::string& name, std::size_t i, double by) {
    Arrays other = played;
    other[name].values[i] += by;
    const Files bytes = files_of(other);
    return data_figures(parse(bytes)).signature;
  };
  EXPECT_NE(changed("acs_2.npy", 149, 0.5), signature);
  EXPECT_NE(changed("rews_3.npy", 0, 0.5), signature);
  EXPECT_NE(changed("rews_3.npy", 24, 0.5), signature);  // 25 floats are no whole number of words
  EXPECT_NE(changed("next_obs_3.npy", 14 * 25 - 1, 0.5), signature);
  EXPECT_NE(changed("dones_0.npy", 3, 1), signature);
}

TEST(DataFigures, AreThoseOfTheRecord) {
  Files files = files_of(arrays());
  const auto figures = data_figures(parse(files));
  require_recorded(parse(files), figures);
  auto record = record_of(25, 3);
  record.figures = figures;
  files["metadata.json"] = metadata_text(record);
  require_recorded(parse(files), figures);
  record.figures.signature += 1;
  files["metadata.json"] = metadata_text(record);
  expect_error<InputFileError>([&] { require_recorded(parse(files), figures); }, "set: the numbers' signature is");
}

}  // namespace
}  // namespace folk::mpe
