#include <folk/games/file_descriptor.h>
#include <folk/games/text_file.h>

#include <fcntl.h>
#include <sys/file.h>
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
  const std::string gone = ".folk-0123456789abcdef.tmp";
  const std::string written = ".folk-0123456789abcdee.tmp";  // by somebody who lives, in whatever container
  const std::vector<std::string> others{
      written,    "f", ".folk-0123456789abcde.tmp", ".folk-0123456789abcdeF.tmp", ".folk-0123456789abcdef.tmp2",
      "notes.tmp"};
  write_file(folder_ / gone, "half");
  for (const auto& name : others) write_file(folder_ / name, "whole");
  const int writer = open((folder_ / written).c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_EQ(flock(writer, LOCK_EX), 0);
  remove_cut_off_writes(folder_);
  EXPECT_FALSE(fs::exists(folder_ / gone));
  for (const auto& name : others) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  close(writer);
  remove_cut_off_writes(folder_);
  EXPECT_FALSE(fs::exists(folder_ / written));
  EXPECT_NO_THROW(remove_cut_off_writes(folder_ / "no such folder"));
}

TEST_F(TextFile, ANameMayBeAsLongAsTheSystemAllows) {
  write_file(folder_ / std::string(255, 'n'), "x");
  require_writable(folder_ / std::string(255, 'n'));
  EXPECT_EQ(files(), 1U);
}

// The name that a writer takes for a while is laid by nobody else: a link there would show it another file.
TEST_F(TextFile, NobodyLaysATemporaryFile) {
  const fs::path mine = folder_ / "mine";
  for (int i = 0; i < 20; ++i)
    write_file(mine, [&](std::ostream& out) {
      out << i;
      EXPECT_LE(files(), 1U);  // it is made when its content is known
    });
  EXPECT_EQ(read_text_file(mine), "19");
}

TEST_F(TextFile, ReadsOrdinaryFilesAlone) {
  write_file(folder_ / "f", "x");
  EXPECT_EQ(read_ordinary_file(folder_ / "f", 10), "x");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  expect_error<InputFileError>([&] { read_ordinary_file(folder_ / "pipe", 10); }, "pipe: is no ordinary file");
  expect_error<InputFileError>([] { read_ordinary_file("/dev/zero", 10); }, "/dev/zero: is no ordinary file");
}

TEST_F(TextFile, SaysBeforeTheWorkWhatCannotBeWritten) {
  const auto refused = [&](const fs::path& path, const std::string& why) {
    expect_error<EnvironmentError>([&] { require_writable(path); }, "cannot be written: " + why);
  };
  refused("", "no name is given");
  refused(folder_ / "", "it is a directory");
  refused(folder_ / "new" / "", "it names no file");
  refused(folder_ / ".", "it is a directory");
  refused(folder_ / std::string(256, 'n'), "File name too long");
  refused(folder_ / "none" / "f", "there is no such folder");
  refused(folder_, "it is a directory");
  fs::create_symlink("none/f", folder_ / "link");
  refused(folder_ / "link", "there is no such folder");
  require_writable("/dev/null");
  require_writable(folder_ / "new");
  EXPECT_EQ(files(), 1U);
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
  fs::create_symlink("made", folder_ / "dangling");
  write_file(folder_ / "dangling", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "dangling"));
  EXPECT_EQ(read_text_file(folder_ / "made"), "new");
  EXPECT_EQ(fs::status(folder_ / "real").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

FileDescriptor unnamed_file() { return FileDescriptor(::open("/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600)); }

std::string content_of(const FileDescriptor& file) {
  std::string text(64, '\0');
  const ssize_t count = ::pread(file.get(), text.data(), text.size(), 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

TEST(FileDescriptor, AllIsWrittenWhereTheFileStandsOrAtAPlace) {
  const FileDescriptor file = unnamed_file();
  ASSERT_GE(file.get(), 0);
  EXPECT_FALSE(write_all(file, "abc"));
  EXPECT_FALSE(write_all(file, "def"));
  EXPECT_FALSE(write_all_at(file, "XY", 2));
  EXPECT_FALSE(write_all_at(file, "", 9));
  EXPECT_EQ(content_of(file), "abXYef");
}

TEST(FileDescriptor, WhatCannotBeWrittenSaysWhy) {
  const FileDescriptor full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
  ASSERT_GE(full.get(), 0);
  EXPECT_EQ(write_all(full, "x"), std::errc::no_space_on_device);
  const FileDescriptor for_reading(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  EXPECT_EQ(write_all(for_reading, "x"), std::errc::bad_file_descriptor);
  EXPECT_EQ(write_all(FileDescriptor(), "x"), std::errc::bad_file_descriptor);
}

}  // namespace
}  // namespace folk
