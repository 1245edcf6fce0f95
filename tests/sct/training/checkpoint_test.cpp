#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/sct/training/checkpoint.h>
#include <folk/sct/training/checkpoint_folder.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "sct/training/small_checkpoint.h"

namespace folk::sct {
namespace {

namespace fs = std::filesystem;
using test::expect_error;
using test::small_checkpoint;

const std::string& small_bytes() {
  static const std::string bytes = checkpoint_bytes(small_checkpoint());
  return bytes;
}

void expect_refusal(const std::string& bytes, const std::string& part) {
  expect_error<InputFileError>([&] { parse_checkpoint(bytes, "c.checkpoint"); }, "c.checkpoint: " + part);
}

/// Expects a checkpoint that was written after `change` to be refused, though its checksum is right.
void expect_refusal_of(const std::function<void(Checkpoint&)>& change, const std::string& part) {
  auto checkpoint = small_checkpoint();
  change(checkpoint);
  expect_refusal(checkpoint_bytes(checkpoint), part);
}

TEST(Checkpoint, KeepsEverything) {
  const auto checkpoint = small_checkpoint();
  const auto back = parse_checkpoint(small_bytes(), "c");
  EXPECT_EQ(back.run, checkpoint.run);
  EXPECT_EQ(back.training.parameters, checkpoint.training.parameters);
  EXPECT_EQ(back.training.average, checkpoint.training.average);
  EXPECT_EQ(back.training.optimiser.first, checkpoint.training.optimiser.first);
  EXPECT_TRUE(std::signbit(back.training.optimiser.first[2]));
  EXPECT_EQ(back.training.optimiser.second, checkpoint.training.optimiser.second);
  EXPECT_EQ(back.training.optimiser.steps, 25U);
  EXPECT_EQ(back.losses, checkpoint.losses);
  ASSERT_EQ(back.added.size(), 2U);
  EXPECT_EQ(back.added[0].observations, checkpoint.added[0].observations);
  EXPECT_EQ(back.added[0].wanted, checkpoint.added[0].wanted);
  EXPECT_EQ(back.added[0].returns, checkpoint.added[0].returns);
  EXPECT_EQ(back.added[1].weights, checkpoint.added[1].weights);
  EXPECT_EQ(back.history, checkpoint.history);
  EXPECT_EQ(back.kept_parameters, checkpoint.kept_parameters);
  EXPECT_EQ(checkpoint_bytes(back), small_bytes());
}

TEST(Checkpoint, KeepsWhatIsHeldOut) {
  auto checkpoint = small_checkpoint();
  for (auto& evaluation : checkpoint.history)
    for (auto& score : evaluation.scores) score.held_out = {score.total / 2, score.accuracy};
  const auto bytes = checkpoint_bytes(checkpoint);
  EXPECT_EQ(parse_checkpoint(bytes, "c").history, checkpoint.history);
  EXPECT_EQ(bytes.size(), small_bytes().size() + 4 * 2 * 8);
  checkpoint.history[1].scores[0].held_out->accuracy = 1.5;
  expect_refusal(checkpoint_bytes(checkpoint), "damaged checkpoint: an accuracy");
}

// A checkpoint of a run that holds nobody out is what it was before anybody could.
TEST(Checkpoint, IsTheFileOfTheCorpus) {
  const fs::path file = FOLK_SOURCE_DIR "/tests/fuzz/corpus/checkpoint/small";
  EXPECT_EQ(read_file(file, largest_checkpoint), small_bytes());
}

TEST(Checkpoint, KeepsTheEmptyBeginning) {
  const auto bytes = checkpoint_bytes({});
  EXPECT_EQ(checkpoint_bytes(parse_checkpoint(bytes, "c")), bytes);
}

TEST(Checkpoint, EveryTruncationIsRefused) {
  for (std::size_t size = 0; size < small_bytes().size(); ++size) expect_refusal(small_bytes().substr(0, size), "");
  expect_refusal(small_bytes() + "x", "damaged checkpoint");
}

TEST(Checkpoint, EveryFlippedBitIsRefused) {
  for (std::size_t i = 0; i < 8 * small_bytes().size(); ++i) {
    auto bytes = small_bytes();
    bytes[i / 8] = static_cast<char>(bytes[i / 8] ^ (1 << (i % 8)));
    expect_refusal(bytes, "");
  }
}

TEST(Checkpoint, ForeignFilesAreNamed) {
  expect_refusal("", "no checkpoint of sct-train");
  expect_refusal(std::string(1000, 'x'), "no checkpoint of sct-train");
  auto newer = small_bytes();
  newer[8] = 2;
  expect_refusal(newer, "a checkpoint of version 2");
}

TEST(Checkpoint, WhatMakesNoSenseIsRefusedThoughItsChecksumIsRight) {
  expect_refusal_of([](auto& c) { c.added[0].own[1] = 2; }, "damaged checkpoint: a lesson with an impossible move");
  expect_refusal_of([](auto& c) { c.added[0].observations[1] = 5; }, "damaged checkpoint: a lesson with an impossible");
  expect_refusal_of([](auto& c) { c.added[0].returns.pop_back(); }, "damaged checkpoint: a lesson of two lengths");
  expect_refusal_of([](auto& c) { c.kept = 2; }, "damaged checkpoint: 2 as the index of the policy that is kept");
  expect_refusal_of([](auto& c) { c.kept_parameters.pop_back(); }, "damaged checkpoint: a kept policy of another size");
  expect_refusal_of([](auto& c) { c.history[1].steps = 10; }, "damaged checkpoint: an evaluation at step 10");
  expect_refusal_of([](auto& c) { c.history[1].steps = 26; }, "damaged checkpoint: an evaluation at step 26");
  expect_refusal_of([](auto& c) { c.history[0].scores.clear(); }, "damaged checkpoint: an evaluation without scores");
  expect_refusal_of([](auto& c) { c.history[0].scores[0].accuracy = 1.5; }, "damaged checkpoint: an accuracy");
  expect_refusal_of([](auto& c) { c.run = std::string(100'000, 'x'); }, "damaged checkpoint: settings that are too");
}

TEST(Checkpoint, WhatHasDivergedIsNotWritten) {
  auto checkpoint = small_checkpoint();
  checkpoint.training.optimiser.second[1] = std::numeric_limits<float>::quiet_NaN();
  expect_error<UsageError>([&] { checkpoint_bytes(checkpoint); }, "training has diverged");
}

TEST(Checkpoint, RunsDifferInTheirFirstLineThatIsNotTheSame) {
  EXPECT_EQ(difference_of_runs("a = 1\nb = 2\n", "a = 1\nb = 2\n"), "");
  EXPECT_EQ(difference_of_runs("a = 1\nb = 2\n", "a = 1\nb = 3\n"), "b = 2 there, 3 here");
  EXPECT_EQ(difference_of_runs("a = 1\n", "a = 1\nb = 3\n"), "b = none there, 3 here");
  EXPECT_EQ(difference_of_runs("a = 1\nb = 2\n", "a = 1\n"), "b = 2 there, none here");
}

// ---- its folder --------------------------------------------------------------------------------------------------

class CheckpointFolderTest : public testing::Test {
protected:
  CheckpointFolderTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::temp_directory_path() / (std::string("folk_") + test->name() + std::to_string(::getpid()));
    fs::remove_all(path_);
  }
  ~CheckpointFolderTest() override { fs::remove_all(path_); }

  static Checkpoint at(std::uint64_t steps) {
    auto checkpoint = small_checkpoint();
    checkpoint.training.optimiser.steps = steps;
    return checkpoint;
  }

  /// Names of the files, but for the lock.
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(path_))
      if (entry.path().filename() != "lock") found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
  }

  fs::path path_;
  std::vector<std::string> skipped_;
  std::function<void(const std::string&)> skip_ = [this](const std::string& fault) { skipped_.push_back(fault); };
};

TEST_F(CheckpointFolderTest, KeepsTheLastTwo) {
  CheckpointFolder folder(path_ / "deep");
  EXPECT_FALSE(folder.newest(skip_));
  for (const std::uint64_t steps : {90, 100, 1000}) folder.write(at(steps));
  ASSERT_EQ(folder.checkpoints().size(), 2U);
  EXPECT_EQ(folder.checkpoints().front().filename(), "step-100.checkpoint");  // by number, not by letter
  EXPECT_EQ(folder.newest(skip_)->training.optimiser.steps, 1000U);
  EXPECT_TRUE(skipped_.empty());
}

TEST_F(CheckpointFolderTest, ADamagedOneGivesWayToTheOneBefore) {
  CheckpointFolder folder(path_);
  folder.write(at(100));
  folder.write(at(200));
  write_file(path_ / "step-200.checkpoint", "FOLK");
  EXPECT_EQ(folder.newest(skip_)->training.optimiser.steps, 100U);
  ASSERT_EQ(skipped_.size(), 1U);
  EXPECT_NE(skipped_[0].find("step-200.checkpoint"), std::string::npos);
  write_file(path_ / "step-100.checkpoint", "");
  expect_error<InputFileError>([&] { folder.newest(skip_); }, "step-200.checkpoint: no checkpoint");
}

TEST_F(CheckpointFolderTest, TakesAwayWhatACutOffWriteLeft) {
  fs::create_directories(path_);
  write_file(path_ / ".folk-0123456789abcdef.tmp", "FOL");
  write_file(path_ / "notes.tmp", "mine");
  const CheckpointFolder folder(path_);
  EXPECT_EQ(names(), std::vector<std::string>{"notes.tmp"});
}

TEST_F(CheckpointFolderTest, IsOneRunsAtATime) {
  {
    const CheckpointFolder folder(path_);
    expect_error<EnvironmentError>([&] { CheckpointFolder{path_}; }, "another run is using it");
  }
  EXPECT_NO_THROW(CheckpointFolder{path_});
}

TEST_F(CheckpointFolderTest, AFailedWriteLeavesTheOlderOnes) {
  CheckpointFolder folder(path_);
  folder.write(at(100));
  fs::create_directory(path_ / "step-200.checkpoint");  // in the way
  expect_error<EnvironmentError>([&] { folder.write(at(200)); }, "cannot be written");
  fs::remove(path_ / "step-200.checkpoint");
  EXPECT_EQ(names(), std::vector<std::string>{"step-100.checkpoint"});
}

TEST_F(CheckpointFolderTest, AFileInItsPlaceIsNamed) {
  write_file(path_, "a file");
  expect_error<EnvironmentError>([&] { CheckpointFolder{path_}; }, "name another");
}

}  // namespace
}  // namespace folk::sct
