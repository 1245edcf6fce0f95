// The ecology of a sample against that of a listed roster, and what its winner earns from the class.

#include <folk/analysis/evolution/class_selection.h>
#include <folk/analysis/evolution/sample_champion.h>
#include <folk/games/error.h>
#include <folk/strategies/standard/memory_machine.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace folk {
namespace {

SampleChampionSettings sampled(std::size_t sample, std::uint64_t seed = 1) {
  SampleChampionSettings settings;
  settings.criterion = Criterion::finite(1000);
  settings.sample = sample;
  settings.seed = seed;
  return settings;
}

TEST(SampleChampion, OfASampleThatIsTheClassIsThatOfTheClass) {
  const MemoryClass members(1, 1);
  const SampleChampions found = sample_champions(members, sampled(32));
  const Population start(32, 100);
  Evolution whole(std::make_shared<ClassSelection>(members, Payoffs{}, Criterion::finite(1000), start, 1), start);
  whole.run(1000);
  std::vector<std::string> names;
  for (const PopulationRank& entry : whole.ranking())
    if (entry.rank == 1) names.push_back(members.member(entry.entrant).name());
  std::vector<std::string> winners;
  for (const SampleWinner& winner : found.winners) winners.push_back(winner.member);
  std::sort(names.begin(), names.end());
  std::sort(winners.begin(), winners.end());
  EXPECT_EQ(winners, names);
  EXPECT_EQ(found.winners[0].population, whole.ranking()[0].population);
  EXPECT_EQ(found.generations, whole.state().generation);
  EXPECT_EQ(found.end, whole.state().end);
  EXPECT_EQ(found.individuals, summary_of(0, whole.state().population).individuals);
  EXPECT_EQ(found.survivors, summary_of(0, whole.state().population).living);
}

TEST(SampleChampion, IsTheSeedsWhateverTheThreadsAndScoredAgainstTheClass) {
  const MemoryClass members(2, 3);
  SampleChampionSettings settings = sampled(60, 5);
  settings.most_leaves = 3'000'000;
  const SampleChampions found = sample_champions(members, settings);
  ASSERT_FALSE(found.winners.empty());
  const SampleWinner& winner = found.winners[0];
  ASSERT_TRUE(winner.score);
  const auto machine = MemoryMachine::parse(winner.member);
  EXPECT_EQ(*winner.score->exact_mean, *score_against(members, *machine, settings).exact_mean);
  settings.threads = 3;
  EXPECT_EQ(sample_champions(members, settings).winners[0].member, winner.member);
  settings.most_leaves = 2;
  EXPECT_FALSE(sample_champions(members, settings).winners[0].score) << "it tells more than two kinds apart";
  settings.seed = 6;
  EXPECT_NE(sample_champions(members, settings).winners[0].member, winner.member);
}

TEST(SampleChampion, RefusesMoreThanThereAre) {
  EXPECT_THROW(sample_champions({1, 1}, sampled(33)), UsageError);
  EXPECT_THROW(sample_champions({3, 3}, sampled(MemoryClass::most_listed + 1)), UsageError);
  EXPECT_THROW(sample_champions({1, 1}, sampled(0)), UsageError);
  Progress progress;
  progress.cancel();
  EXPECT_THROW(sample_champions({1, 1}, sampled(5), progress), Cancelled);
}

}  // namespace
}  // namespace folk
