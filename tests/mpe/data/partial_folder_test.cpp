#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/data/partial_folder.h>
#include <gtest/gtest.h>

#include <optional>

#include "games/expect_error.h"
#include "mpe/data/small_data_set.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using test::Folder;
using Names = std::vector<std::string>;

TEST(PartialFolder, GetsItsNameAtTheEnd) {
  const Folder folder;
  PartialFolder partial(folder / "above/out/");
  EXPECT_EQ(partial.path(), folder / "above/out.partial");
  write_file(partial.path() / "a", "1");
  EXPECT_EQ(folder.names("above"), Names{"out.partial"});
  partial.publish();
  EXPECT_EQ(folder.names("above"), Names{"out"});
  EXPECT_EQ(folder.names("above/out"), Names{"a"});
}

TEST(PartialFolder, KeepsWhatAnEarlierRunLeft) {
  const Folder folder;
  {
    const PartialFolder partial(folder / "out");
    write_file(partial.path() / "a", "1");
    write_file(partial.path() / ".folk-0123456789abcdef.tmp", "cut off");
  }
  EXPECT_EQ(folder.names("out.partial"), (Names{".folk-0123456789abcdef.tmp", "a", "lock"}));
  PartialFolder partial(folder / "out");
  EXPECT_EQ(folder.names("out.partial"), (Names{"a", "lock"}));
  partial.clear();
  EXPECT_EQ(folder.names("out.partial"), Names{"lock"});
  write_file(partial.path() / "a", "1");
  partial.remove();
  EXPECT_EQ(folder.names(), Names{});
}

TEST(PartialFolder, IsOneRuns) {
  const Folder folder;
  std::optional<PartialFolder> first(std::in_place, folder / "out");
  expect_error<EnvironmentError>([&] { PartialFolder(folder / "out"); }, "out.partial: another run is writing it");
  first->publish();
  const PartialFolder next(folder / "out");  // the lock that the first still holds went with its folder
  first.reset();
  expect_error<EnvironmentError>([&] { PartialFolder(folder / "out"); }, "another run is writing it");
}

TEST(PartialFolder, LeavesWhatIsNotOurs) {
  const Folder folder;
  std::filesystem::create_directories(folder / "out.partial");
  write_file(folder / "out.partial/thesis.tex", "years of work");
  expect_error<EnvironmentError>([&] { PartialFolder(folder / "out"); }, "out.partial: is in the way");
  EXPECT_EQ(folder.names("out.partial"), Names{"thesis.tex"});
  std::filesystem::create_directories(folder / "elsewhere");
  std::filesystem::create_symlink(folder / "elsewhere", folder / "link.partial");
  expect_error<EnvironmentError>([&] { PartialFolder(folder / "link"); }, "link.partial: is in the way");
  std::filesystem::create_directories(folder / "empty.partial");
  EXPECT_NO_THROW(PartialFolder(folder / "empty"));
}

TEST(PartialFolder, SaysWhatIsInItsWay) {
  const Folder folder;
  write_file(folder / "file", "");
  expect_error<EnvironmentError>([&] { PartialFolder(folder / "file/out"); }, "file/out.partial: cannot be made");
  write_file(folder / "out.partial", "");
  expect_error<EnvironmentError>([&] { PartialFolder(folder / "out"); }, "out.partial: cannot be made: ");
  PartialFolder partial(folder / "other");
  std::filesystem::create_directories(folder / "other/full");
  expect_error<EnvironmentError>([&] { partial.publish(); }, "other: cannot be given to");
  EXPECT_EQ(folder.names("other.partial"), Names{"lock"});
}

}  // namespace
}  // namespace folk::mpe
