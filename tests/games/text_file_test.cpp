#include <folk/games/text_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "games/expect_error.h"

namespace folk {
namespace {

namespace fs = std::filesystem;
using test::expect_error;

/// A folder of its own for each test.
class TextFile : public testing::Test {
protected:
  TextFile() {
    std::string name = (fs::temp_directory_path() / "folk-text-file-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for the test");
    folder_ = name;
  }
  ~TextFile() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }

  fs::path folder_;
};

TEST_F(TextFile, WritesAndReadsBytes) {
  const std::string bytes("a\r\n\0\xFF z", 7);
  write_file(folder_ / "f", bytes);
  EXPECT_EQ(read_text_file(folder_ / "f"), bytes);
  write_file(folder_ / "f", "");
  EXPECT_EQ(read_text_file(folder_ / "f"), "");
  EXPECT_EQ(files(), 1U);
}

TEST_F(TextFile, TakesAwayWhatKilledWritersLeft) {
  // No process has the largest number that a pid can hold; our own lives.
  const std::string gone = "f.2147483647.0.tmp";
  const std::string ours = "f." + std::to_string(::getpid()) + ".3.tmp";
  const std::vector<std::string> others{
      ours, "f", "g.2147483647.0.tmp", "f.2147483647.tmp", "f.x.0.tmp", "f.2147483647.0.tmp2"};
  write_file(folder_ / gone, "half");
  for (const auto& name : others) write_file(folder_ / name, "whole");
  remove_cut_off_writes(folder_ / "f");
  EXPECT_FALSE(fs::exists(folder_ / gone));
  for (const auto& name : others) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  EXPECT_NO_THROW(remove_cut_off_writes(folder_ / "no such folder" / "f"));
}

TEST_F(TextFile, ReadsMoreThanABlock) {
  const std::string bytes(200'001, 'x');
  write_file(folder_ / "f", bytes);
  EXPECT_EQ(read_text_file(folder_ / "f"), bytes);
}

TEST_F(TextFile, RefusesToRead) {
  const auto read = [this](const std::string& name) { return [this, name] { read_text_file(folder_ / name); }; };
  expect_error<InputFileError>(read("missing"), "missing: no such file; check the name");
  expect_error<InputFileError>(read("missing/file"), "no such file");
  expect_error<InputFileError>(read("."), "is a directory, not a file");
  expect_error<InputFileError>(read(std::string(300, 'n')), "cannot be opened");
  expect_error<InputFileError>(read("two\nlines"), "two?lines: no such file");
}

TEST_F(TextFile, RefusesWhatIsTooLarge) {
  write_file(folder_ / "f", "");
  fs::resize_file(folder_ / "f", largest_text_file + 1);  // sparse: takes no disk
  expect_error<InputFileError>([&] { read_text_file(folder_ / "f"); }, "larger than 64 MiB");
}

TEST_F(TextFile, RefusesAPipeThatNeverEnds) {
  if (!fs::exists("/dev/zero")) GTEST_SKIP();
  expect_error<InputFileError>([] { read_text_file("/dev/zero"); }, "/dev/zero: larger than 64 MiB");
}

TEST_F(TextFile, RefusesToWrite) {
  const auto write = [this](const std::string& name) { return [this, name] { write_file(folder_ / name, "x"); }; };
  expect_error<EnvironmentError>(write("."), "cannot be written: it is a directory");
  expect_error<EnvironmentError>(write("missing/f"), "missing/f: cannot be written: No such file or directory");
  expect_error<EnvironmentError>(write(std::string(300, 'n')), "cannot be written");
  write_file(folder_ / "file", "x");
  expect_error<EnvironmentError>(write("file/f"), "cannot be written");
  EXPECT_EQ(files(), 1U);
}

TEST_F(TextFile, RefusesWhatPermissionsForbid) {
  const fs::path locked = folder_ / "locked";
  fs::create_directory(locked);
  write_file(folder_ / "secret", "x");
  fs::permissions(folder_ / "secret", fs::perms::none);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
  fs::permissions(folder_, fs::perms::owner_all | fs::perms::others_exec | fs::perms::others_read);
  // Root may do anything: be nobody for a while.
  const uid_t user = geteuid();
  ASSERT_TRUE(user != 0 || seteuid(65534) == 0);
  expect_error<EnvironmentError>([&] { write_file(locked / "f", "x"); }, "cannot be written: Permission denied");
  expect_error<InputFileError>([&] { read_text_file(folder_ / "secret"); }, "cannot be opened: Permission denied");
  ASSERT_TRUE(user != 0 || seteuid(user) == 0);
  fs::permissions(locked, fs::perms::owner_all);
}

TEST_F(TextFile, AFailingWriterLeavesTheOldFile) {
  write_file(folder_ / "f", "old");
  EXPECT_THROW(write_file(folder_ / "f",
                          [](std::ostream& out) {
                            out << "half of the new";
                            throw std::runtime_error("no more");
                          }),
               std::runtime_error);
  expect_error<EnvironmentError>(
      [&] { write_file(folder_ / "f", [](std::ostream& out) { out.setstate(std::ios::badbit); }); },
      "cannot be written");
  EXPECT_EQ(read_text_file(folder_ / "f"), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(TextFile, SaysThatTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  expect_error<EnvironmentError>([] { write_file("/dev/full", "x"); }, "/dev/full: cannot be written: No space left");
}

TEST_F(TextFile, WritesToPipesInPlace) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write_file(pipe, "through");
  char bytes[16];
  EXPECT_EQ(::read(reader, bytes, sizeof bytes), 7);
  close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(TextFile, KeepsLinksAndPermissions) {
  write_file(folder_ / "real", "old");
  fs::permissions(folder_ / "real", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real", folder_ / "link");
  write_file(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_text_file(folder_ / "real"), "new");
  EXPECT_EQ(fs::status(folder_ / "real").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

}  // namespace
}  // namespace folk
