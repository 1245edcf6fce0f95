#include <folk/mpe/study/study_blocks.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mpe/study/made_up_tables.h"

namespace folk::mpe {
namespace {

using test::made_up_tables;

template <class Row>
std::vector<std::string> learners_of(const StudyBlock<Row>& block) {
  std::vector<std::string> learners;
  for (const auto& line : block.lines) learners.push_back(line.learner);
  return learners;
}

TEST(StudyBlocks, LearnersStandAbovePlayers) {
  const auto tables = made_up_tables();
  const auto blocks = score_blocks(tables);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[0].scenario, "simple_tag");
  EXPECT_EQ(blocks[0].level, "expert");
  EXPECT_EQ(blocks[0].columns, (std::vector<std::string>{"released", "still"}));
  EXPECT_EQ(learners_of(blocks[0]), (std::vector<std::string>{"sct", "madt", "matd3", "lead_pursuit"}));
  EXPECT_EQ(blocks[0].lines[0].cells, (std::vector<const ScoreRow*>{&tables.scores[1], &tables.scores[2]}));
  EXPECT_EQ(blocks[0].lines[1].cells, (std::vector<const ScoreRow*>{&tables.scores[3], nullptr}));
  // Players without data stand with every level of their scenario, and with no other.
  EXPECT_EQ(learners_of(blocks[1]), (std::vector<std::string>{"sct", "lead_pursuit"}));
  EXPECT_EQ(learners_of(blocks[2]), (std::vector<std::string>{"omar"}));
}

TEST(StudyBlocks, KnowWhetherTheyAreBegun) {
  const auto tables = made_up_tables();
  EXPECT_TRUE(score_blocks(tables)[0].begun());
  EXPECT_FALSE(score_blocks(tables)[2].begun());
  EXPECT_TRUE(accuracy_blocks(tables)[0].begun());
}

TEST(StudyBlocks, OtherBlocksHaveTheirColumns) {
  const auto tables = made_up_tables();
  EXPECT_EQ(blend_blocks(tables)[0].columns, (std::vector<std::string>{"1", "0.3"}));
  EXPECT_EQ(learners_of(blend_blocks(tables)[0]), (std::vector<std::string>{"sct", "omar", "lead_pursuit"}));
  EXPECT_EQ(forced_blocks(tables)[0].columns, (std::vector<std::string>{"none", "truth"}));
  EXPECT_EQ(learners_of(forced_blocks(tables)[0]), (std::vector<std::string>{"sct, still", "sct-selfconf, still"}));
  const auto paired = paired_blocks(tables);
  ASSERT_EQ(paired.size(), 1U);
  EXPECT_EQ(paired[0].columns, (std::vector<std::string>{"released", "still"}));
  EXPECT_EQ(learners_of(paired[0]), (std::vector<std::string>{"SCT minus OMAR", "SCT minus MADT"}));
  EXPECT_EQ(paired[0].lines[1].cells, (std::vector<const PairedRow*>{&tables.paired[1], &tables.paired[3]}));
  EXPECT_TRUE(paired[0].begun());
  EXPECT_EQ(asked_blocks(tables)[0].columns, (std::vector<std::string>{"80"}));
}

TEST(StudyBlocks, PlacesCountTheirSeeds) {
  const auto places = study_places(made_up_tables());
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[0].learner, "lead_pursuit");
  EXPECT_EQ(places[0].seeds, 1U);
  EXPECT_EQ(places[1].seeds, 3U);
  EXPECT_EQ(places[2].learner, "omar");
  EXPECT_EQ(places[2].seeds, 0U);
}

}  // namespace
}  // namespace folk::mpe
