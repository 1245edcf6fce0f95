#include <folk/sct/files/checkpoint_files.h>
#include <folk/sct/files/made_folder.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace folk::sct {
namespace {

namespace fs = std::filesystem;

class MadeFolderTest : public testing::Test {
protected:
  MadeFolderTest() {
    std::string pattern = (fs::temp_directory_path() / "folk_made_XXXXXX").string();
    root_ = ::mkdtemp(pattern.data());
  }
  ~MadeFolderTest() override { fs::remove_all(root_); }

  fs::path root_;
};

TEST_F(MadeFolderTest, WhatIsEmptyGoesAndWhatWasThereStays) {
  {
    std::error_code error;
    const MadeFolder made(root_ / "a/b/c", error);
    EXPECT_FALSE(error);
    EXPECT_TRUE(made.made());
    EXPECT_TRUE(fs::is_directory(root_ / "a/b/c"));
    std::ofstream(root_ / "a/file") << "kept";
    const MadeFolder again(root_ / "a/b/c/", error);
    EXPECT_FALSE(again.made());
  }
  EXPECT_TRUE(fs::exists(root_ / "a/file"));
  EXPECT_FALSE(fs::exists(root_ / "a/b"));
  std::error_code error;
  const MadeFolder none(root_ / "a/file/x", error);
  EXPECT_TRUE(error);
}

TEST_F(MadeFolderTest, AFolderOfCheckpointsIsGoneWithoutAny) {
  const fs::path path = root_ / "run/seed-1";
  std::optional<CheckpointFiles> files(path);
  EXPECT_TRUE(fs::exists(path / "lock"));
  files.reset();
  EXPECT_FALSE(fs::exists(root_ / "run"));
  files.emplace(path);
  files->write_bytes(3, "checkpoint");
  files.reset();
  files.emplace(path);  // it was there already
  EXPECT_EQ(files->checkpoints().size(), 1U);
  files.reset();
  EXPECT_TRUE(fs::exists(path / "step-3.checkpoint"));
}

}  // namespace
}  // namespace folk::sct
