#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/sct/data/data_folder.h>
#include <folk/sct/files/npy_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "games/expect_error.h"

namespace folk::sct {
namespace {

namespace fs = std::filesystem;
using test::expect_error;

constexpr Move C = Move::C;
constexpr Move D = Move::D;

class DataFolder : public testing::Test {
protected:
  DataFolder() {
    std::string name = (fs::temp_directory_path() / "folk-data-folder-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for the test");
    folder_ = name;
  }
  ~DataFolder() override { fs::remove_all(folder_); }

  void expect_refusal(const std::string& part) const {
    expect_error<InputFileError>([this] { read_data_folder(folder_); }, part);
  }

  /// Writes the two matches and replaces one array.
  void replace(const char* file, const NpyArray& array) const {
    write_data_folder(folder_, matches_);
    write_npy(folder_ / file, array, NpyType::float64);
  }

  fs::path folder_;
  std::vector<Trajectory> matches_{{"grim", "all_d", {C, D, D}, {D, D, D}, {0, 1, 1}},
                                   {"all_c", "sly \"one\"", {C, C, C}, {C, C, D}, {3, 3, 0.1}}};
};

TEST_F(DataFolder, KeepsEverything) {
  write_data_folder(folder_ / "a" / "b", matches_);
  EXPECT_EQ(read_data_folder(folder_ / "a" / "b"), matches_);
}

TEST_F(DataFolder, IsOneArrayAKindOfNumber) {
  write_data_folder(folder_, matches_);
  EXPECT_EQ(read_npy(folder_ / "actions.npy").values, (std::vector<double>{0, 1, 1, 0, 0, 0}));
  EXPECT_EQ(read_npy(folder_ / "opponent_actions.npy").values, (std::vector<double>{1, 1, 1, 0, 0, 1}));
  const NpyArray observations = read_npy(folder_ / "observations.npy");
  EXPECT_EQ(observations.shape, (std::vector<std::size_t>{2, 3, 5}));
  EXPECT_EQ(observations.values, (std::vector<double>{1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1,  // start CD DD
                                                      1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0}));
}

TEST_F(DataFolder, NeedsNoNamesAndNoObservations) {
  write_data_folder(folder_, matches_);
  fs::remove(folder_ / "names.json");
  fs::remove(folder_ / "observations.npy");
  for (Trajectory& match : matches_) match.player = match.opponent = "";
  EXPECT_EQ(read_data_folder(folder_), matches_);
}

TEST_F(DataFolder, TakesNumbersOfAnyType) {
  replace("actions.npy", {{2, 3}, {0, 1, 1, 0, 0, 0}});
  EXPECT_EQ(read_data_folder(folder_), matches_);
}

TEST_F(DataFolder, RefusesWhatIsMissing) {
  expect_error<InputFileError>([this] { read_data_folder(folder_ / "no"); }, "no: no such folder");
  expect_refusal("actions.npy: no such file");
  for (const char* file : {"opponent_actions.npy", "rewards.npy"}) {
    write_data_folder(folder_, matches_);
    fs::remove(folder_ / file);
    expect_refusal(std::string(file) + ": no such file");
  }
}

TEST_F(DataFolder, RefusesOtherShapes) {
  replace("actions.npy", {{6}, {0, 1, 1, 0, 0, 0}});
  expect_refusal("/actions.npy: shape (6): expected (trajectories, rounds)");
  replace("actions.npy", {{0, 3}, {}});
  expect_refusal("/actions.npy: shape (0, 3): expected (trajectories, rounds), at least one");
  replace("opponent_actions.npy", {{3, 2}, {0, 1, 1, 0, 0, 0}});
  expect_refusal("opponent_actions.npy: shape (3, 2), but actions.npy asks for (2, 3)");
  replace("rewards.npy", {{1, 3}, {0, 1, 1}});
  expect_refusal("rewards.npy: shape (1, 3), but actions.npy asks for (2, 3)");
  replace("observations.npy", {{2, 3}, {0, 1, 1, 0, 0, 0}});
  expect_refusal("observations.npy: shape (2, 3), but actions.npy asks for (2, 3, 5)");
}

TEST_F(DataFolder, RefusesOtherValues) {
  replace("actions.npy", {{2, 3}, {0, 1, 1, 0, 0, 2}});
  expect_refusal("/actions.npy: 2 at [1, 2]: expected 0 (C) or 1 (D)");
  replace("opponent_actions.npy", {{2, 3}, {0, std::nan(""), 1, 0, 0, 0}});
  expect_refusal("opponent_actions.npy: nan at [0, 1]: expected 0 (C) or 1 (D)");
  replace("rewards.npy", {{2, 3}, {0, 1, 1, HUGE_VAL, 0, 0}});
  expect_refusal("rewards.npy: inf at [1, 0]: expected a finite payoff");
  write_data_folder(folder_, matches_);
  NpyArray observations = read_npy(folder_ / "observations.npy");
  observations.values[2] = 1;
  replace("observations.npy", observations);
  expect_refusal("observations.npy: 1 at [0, 0, 2]: expected 0, the observation being 'start' in the first round");
  observations.values[2] = 0;
  observations.values[7] = 0.5;
  replace("observations.npy", observations);
  expect_refusal("observations.npy: 0.5 at [0, 1, 2]: expected 1, the observation being CD after round 0");
}

TEST_F(DataFolder, RefusesOtherNames) {
  for (const char* names :
       {"", "[]", "{\"players\": [", "{}", R"({"players": "a"})", R"({"players": ["a"]})", R"({"players": ["a", 2]})",
        R"({"players": ["a", "b"]})", R"({"players": ["a", "b"], "opponents": [["c"], "d"]})"}) {
    write_data_folder(folder_, matches_);
    write_file(folder_ / "names.json", names);
    expect_refusal("names.json: ");
  }
  write_file(folder_ / "names.json", "{\"players\": " + std::string(1'000'000, '['));
  expect_refusal("names.json: ");
}

TEST_F(DataFolder, DoesNotWriteWhatItWouldNotRead) {
  const auto refuses = [this](const std::string& part) {
    expect_error<UsageError>([this] { write_data_folder(folder_, matches_); }, part);
  };
  matches_[1].rewards[2] = std::nan("");
  refuses("a reward of nan in round 2 of 'all_c'");
  matches_[1].rewards.pop_back();
  refuses("trajectories of different lengths");
  matches_.clear();
  refuses("no rounds to write");
  EXPECT_TRUE(fs::is_empty(folder_));
  write_file(folder_ / "file", "");
  matches_ = {{"a", "b", {C}, {C}, {3}}};
  expect_error<EnvironmentError>([this] { write_data_folder(folder_ / "file", matches_); },
                                 "file: the folder cannot be made");
}

}  // namespace
}  // namespace folk::sct
