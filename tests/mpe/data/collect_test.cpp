#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/data/collect.h>
#include <folk/mpe/data/data_figures.h>
#include <folk/mpe/data/data_set.h>
#include <folk/mpe/data/data_writer.h>
#include <folk/mpe/data/partial_folder.h>
#include <folk/mpe/players/noisy.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <optional>
#include <string>

#include "games/ended_work.h"
#include "games/expect_error.h"
#include "mpe/data/small_data_set.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using sct::NpyType;
using test::Files;
using test::files_of;
using test::Folder;
using test::played_arrays;
using test::pursuit_cast;
using Names = std::vector<std::string>;

/// More episodes than two blocks, and not a multiple of a block.
constexpr std::size_t episodes = 150;

const Layout& tag() {
  static const Layout layout(Scenario::named("simple_tag"));
  return layout;
}

DataDescription tag_description(std::size_t count = episodes) {
  return test::description(tag(), pursuit_cast(), count);
}

Files read_folder(const std::filesystem::path& folder) {
  Files files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename().string()] = read_file(entry.path(), std::size_t{1} << 30U);
  return files;
}

/// The files of a whole data set that was collected in one go.
const Files& whole() {
  static const Files files = [] {
    const Folder folder;
    collect(tag(), pursuit_cast(), tag_description(), folder / "whole");
    return read_folder(folder / "whole");
  }();
  return files;
}

/// A run of one thread that is cancelled once `blocks` more of 64 episodes are done; how many are written then.
std::size_t collect_blocks(int blocks, const DataDescription& description, const std::filesystem::path& folder,
                           bool resume = false, const Cast& cast = pursuit_cast()) {
  CollectRules rules;
  rules.resume = resume;
  Progress progress;
  progress = [&](double) {
    if (--blocks == 0) progress.cancel();
  };
  if (blocks == 0) progress.cancel();
  try {
    collect(tag(), cast, description, folder, rules, progress);
  } catch (const CollectionCancelled& cancelled) {
    return cancelled.written;
  }
  ADD_FAILURE() << "it was not cancelled";
  return 0;
}

CollectRules resuming(unsigned threads = 1) {
  CollectRules rules;
  rules.threads = threads;
  rules.resume = true;
  return rules;
}

TEST(Collect, WritesWhatIsPlayed) {
  for (const char* name : {"simple_tag", "simple_world"})
    for (const NpyType type : {NpyType::float32, NpyType::float64}) {
      const Folder folder;
      const Layout layout(Scenario::named(name));
      auto description = test::description(layout, pursuit_cast(), 70);
      description.type = type;
      description.seed = 9;
      description.first_episode = 1000;
      const auto collection = collect(layout, pursuit_cast(), description, folder / "set");
      EXPECT_EQ(collection.end, Collection::End::complete);
      EXPECT_EQ(collection.kept, 0U);
      EXPECT_EQ(collection.written, 70U);
      EXPECT_EQ(folder.names(), Names{"set"});
      Files expected = files_of(played_arrays(layout, pursuit_cast(), 9, 1000, 70), type);
      Files found = read_folder(folder / "set");
      const auto record = parse_metadata(found.at("metadata.json"), "");
      ASSERT_TRUE(record);
      EXPECT_EQ(metadata_text(*record), metadata_text(collection.record));
      EXPECT_EQ(description_text(record->description), description_text(description));
      const DataSet data = DataSet::open(folder / "set");
      require_recorded(data, data_figures(data));
      EXPECT_EQ(record->figures.predator.mean, data_figures(data).predator.mean);
      found.erase("metadata.json");
      EXPECT_TRUE(found == expected) << name << " " << to_string(type);
    }
}

TEST(Collect, ThreadsDoNotMatter) {
  for (const unsigned threads : {2U, 3U}) {
    const Folder folder;
    CollectRules rules;
    rules.threads = threads;
    collect(tag(), pursuit_cast(), tag_description(), folder / "set", rules);
    EXPECT_TRUE(read_folder(folder / "set") == whole()) << threads;
  }
}

TEST(Collect, EpisodesOfPlayersOnAPipeComeOneByOne) {
  Controller one_by_one = random_player();
  one_by_one.one_by_one = true;
  const Folder folder;
  collect(tag(), {lead_pursuit(), one_by_one}, tag_description(), folder / "set");
  EXPECT_TRUE(read_folder(folder / "set") == whole());
}

TEST(Collect, TellsHowFarItIs) {
  const Folder folder;
  double last = 0;
  collect(tag(), pursuit_cast(), tag_description(), folder / "set", {}, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1);
}

TEST(Collect, AnInterruptedRunLeavesNoFolderAndIsResumed) {
  for (int blocks = 0; blocks < 3; ++blocks) {
    const Folder folder;
    EXPECT_EQ(collect_blocks(blocks, tag_description(), folder / "set"), static_cast<std::size_t>(blocks) * 64);
    EXPECT_EQ(folder.names(), Names{"set.partial"});
    auto again = resuming(2);
    const auto second = collect(tag(), pursuit_cast(), tag_description(), folder / "set", again);
    EXPECT_EQ(second.end, Collection::End::complete);
    EXPECT_EQ(second.kept, static_cast<std::size_t>(blocks) * 64);
    EXPECT_EQ(folder.names(), Names{"set"});
    EXPECT_TRUE(read_folder(folder / "set") == whole()) << blocks;
  }
}

// However it ends: the folder is whole or not there, and the same call makes it.
TEST(CollectThreads, EndsAsItsProgressWishes) {
  for (const unsigned threads : {1U, 4U})
    folk::test::expect_ends([&](const Progress& progress) {
      const Folder folder;
      const auto run = [&](const Progress& told) {
        return collect(tag(), pursuit_cast(), tag_description(), folder / "set", resuming(threads), told);
      };
      const auto expect_whole = [&] {
        EXPECT_EQ(folder.names(), Names{"set"});
        EXPECT_TRUE(read_folder(folder / "set") == whole());
      };
      try {
        run(progress);
      } catch (const CollectionCancelled& cancelled) {
        if (folder.names() == Names{"set.partial"}) {
          EXPECT_EQ(run(nullptr).kept, cancelled.written);
        }
        expect_whole();
        throw;
      } catch (const folk::test::Enough&) {
        if (folder.names() == Names{}) run(nullptr);
        expect_whole();
        throw;
      }
      expect_whole();
    });
}

TEST(Collect, ResumesAsOftenAsItIsInterrupted) {
  const Folder folder;
  for (int run = 0; run < 2; ++run) {
    EXPECT_EQ(collect_blocks(1, tag_description(), folder / "set", true), static_cast<std::size_t>(run + 1) * 64);
  }
  EXPECT_EQ(collect(tag(), pursuit_cast(), tag_description(), folder / "set", resuming()).kept, 128U);
  EXPECT_TRUE(read_folder(folder / "set") == whole());
}

/// Writes over a byte of a file.
void damage(const std::filesystem::path& path, std::streamoff place) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(place);
  const int byte = file.get();
  file.seekp(place);
  file.put(static_cast<char>(byte ^ 1));
}

TEST(Collect, RowsThatDidNotReachTheDiskArePlayedAgain) {
  const Folder folder;
  collect_blocks(2, tag_description(), folder / "set");
  damage(folder / "set.partial/obs_2.npy", 128 + 5 * 25 * 16 * 4 + 100);     // of episode 5
  damage(folder / "set.partial/dones_3.npy", 128 + 70 * 25 * 4);             // of episode 70
  damage(folder / "set.partial/journal", 100 * 8);                           // the word of episode 100
  write_file(folder / "set.partial/.folk-0123456789abcdef.tmp", "cut off");  // as kill -9 may leave it
  const auto collection = collect(tag(), pursuit_cast(), tag_description(), folder / "set", resuming());
  EXPECT_EQ(collection.kept, 125U);
  EXPECT_TRUE(read_folder(folder / "set") == whole());
}

TEST(Collect, FilesThatAreNotAllThereAreMadeAgain) {
  const Folder folder;
  collect_blocks(1, tag_description(), folder / "set");
  std::filesystem::remove(folder / "set.partial/rews_0.npy");
  EXPECT_EQ(collect(tag(), pursuit_cast(), tag_description(), folder / "set", resuming()).kept, 0U);
  EXPECT_TRUE(read_folder(folder / "set") == whole());
  std::filesystem::remove_all(folder / "set");
  collect_blocks(1, tag_description(), folder / "set");
  std::filesystem::remove(folder / "set.partial/description.json");  // it comes last
  EXPECT_EQ(collect(tag(), pursuit_cast(), tag_description(), folder / "set", resuming()).kept, 0U);
  EXPECT_TRUE(read_folder(folder / "set") == whole());
}

TEST(Collect, WithoutResumeItBeginsAnew) {
  const Folder folder;
  collect_blocks(2, tag_description(2 * episodes), folder / "set");
  EXPECT_EQ(collect(tag(), pursuit_cast(), tag_description(), folder / "set").kept, 0U);
  EXPECT_TRUE(read_folder(folder / "set") == whole());
}

TEST(Collect, DoesNotGoOnWithAnotherDataSet) {
  const Folder folder;
  collect_blocks(1, tag_description(), folder / "set");
  auto other = tag_description();
  other.seed = 2;
  expect_error<UsageError>([&] { collect(tag(), pursuit_cast(), other, folder / "set", resuming()); },
                           "set.partial: an unfinished data set of another kind: seed = 1 there, 2 here");
  // Players of the same name that act otherwise.
  Controller changed = greedy_pursuit();
  changed.name = "lead_pursuit";
  expect_error<UsageError>(
      [&] {
        collect(tag(), {changed, random_player()}, tag_description(), folder / "set", resuming());
      },
      "episode 0 is played otherwise now");
  EXPECT_EQ(collect(tag(), pursuit_cast(), tag_description(), folder / "set", resuming()).kept,
            64U);  // all still there
  EXPECT_TRUE(read_folder(folder / "set") == whole());
}

TEST(Collect, AFolderThatIsThereStays) {
  const Folder folder;
  collect(tag(), pursuit_cast(), tag_description(), folder / "set");
  const auto again = [&](const DataDescription& description, const CollectRules& rules) {
    return collect(tag(), pursuit_cast(), description, folder / "set", rules);
  };
  expect_error<UsageError>([&] { again(tag_description(), {}); }, "set: it is there already");
  const auto collection = again(tag_description(), resuming());
  EXPECT_EQ(collection.end, Collection::End::was_there);
  EXPECT_EQ(metadata_text(collection.record), whole().at("metadata.json"));
  auto other = tag_description();
  other.noise = 0.5;
  expect_error<UsageError>([&] { again(other, resuming()); }, "set: another data set is there: noise = 0.0 there, 0.5");
  Controller changed = greedy_pursuit();
  changed.name = "lead_pursuit";
  expect_error<UsageError>(
      [&] {
        collect(tag(), {changed, random_player()}, tag_description(), folder / "set", resuming());
      },
      "is played otherwise now");
  damage(folder / "set/acs_1.npy", 128 + 1000);
  expect_error<InputFileError>([&] { again(tag_description(), resuming()); }, "the numbers' signature is");
  std::filesystem::remove(folder / "set/metadata.json");
  expect_error<UsageError>([&] { again(tag_description(), resuming()); }, "without a record");
  EXPECT_EQ(folder.names(), Names{"set"});
  write_file(folder / "file", "");
  expect_error<UsageError>([&] { collect(tag(), pursuit_cast(), tag_description(), folder / "file"); },
                           "file: it is there already");
  std::filesystem::create_symlink("nowhere", folder / "link");
  expect_error<UsageError>([&] { collect(tag(), pursuit_cast(), tag_description(), folder / "link"); },
                           "link: it is there already");
}

TEST(Collect, TwoRunsOfOneNameDoNotMeet) {
  const Folder folder;
  const PartialFolder other(folder / "set");
  expect_error<EnvironmentError>([&] { collect(tag(), pursuit_cast(), tag_description(), folder / "set"); },
                                 "set.partial: another run is writing it");
}

/// A player that fails in a certain episode.
Controller failing(std::uint64_t episode, double action) {
  struct Failing final : Player {
    Failing(std::uint64_t episode, double action)
        : episode_(episode),
          action_(action) {}
    void act(const Layout&, const Block& block, std::size_t agent, const Moment& moment) override {
      const auto [x, y] = action_rows(block, agent);
      for (std::size_t lane = 0; lane < block.lanes; ++lane) {
        x[lane] = moment.first + lane == episode_ ? action_ : 0;
        y[lane] = 0;
      }
    }
    std::uint64_t episode_;
    double action_;
  };
  return {"failing", each([=](const Layout&, std::size_t) { return std::make_unique<Failing>(episode, action); })};
}

TEST(Collect, WhatFailsLeavesNothing) {
  const Folder folder;
  for (const NpyType type : {NpyType::float32, NpyType::float64}) {
    auto description = tag_description();
    description.type = type;
    const auto run = [&](double action) {
      collect(tag(), {failing(100, action), still_player()}, description, folder / "set");
    };
    expect_error<UsageError>([&] { run(std::nan("")); }, "not finite");
    EXPECT_EQ(folder.names(), Names{});
    expect_error<UsageError>([&] { run(1e50); }, "agent 0: an action of 1e+50 does not fit a float");
    EXPECT_EQ(folder.names(), Names{});
  }
}

TEST(Collect, WhatFailsInAResumedRunLeavesWhatWasThere) {
  const Folder folder;
  const Cast cast{failing(100, std::nan("")), still_player()};
  const auto description = tag_description();
  collect_blocks(1, description, folder / "set", false, cast);
  expect_error<UsageError>([&] { collect(tag(), cast, description, folder / "set", resuming()); }, "not finite");
  EXPECT_EQ(folder.names(), Names{"set.partial"});
}

TEST(Collect, AFileThatCannotBeMadeIsNamed) {
  const Folder folder;
  expect_error<EnvironmentError>([&] { DataWriter(folder / "none", tag().scenario(), NpyType::float32, 1); },
                                 "none/obs_0.npy: cannot be made: No such file");
}

TEST(Collect, NoiseIsOfTheCast) {
  const Folder folder;
  const Cast cast{noisy(lead_pursuit(), 0.3), random_player()};
  collect(tag(), cast, tag_description(2), folder / "set");
  Files expected = files_of(played_arrays(tag(), cast, 1, 0, 2));
  Files found = read_folder(folder / "set");
  found.erase("metadata.json");
  EXPECT_TRUE(found == expected);
  EXPECT_NE(found.at("acs_0.npy"), files_of(played_arrays(tag(), pursuit_cast(), 1, 0, 2)).at("acs_0.npy"));
}

TEST(Collect, TheDescriptionIsOfTheSameScenario) {
  const Folder folder;
  const Layout world(Scenario::named("simple_world"));
  expect_error<UsageError>([&] { collect(world, pursuit_cast(), tag_description(), folder / "set"); },
                           "a description of another scenario");
  expect_error<UsageError>([&] { collect(tag(), pursuit_cast(), tag_description(0), folder / "set"); }, "no episodes");
}

}  // namespace
}  // namespace folk::mpe
