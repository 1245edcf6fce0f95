#include <folk/analysis/pictures/caption.h>

#include <gtest/gtest.h>

namespace folk {
namespace {

const std::string version = caption_text({});

TEST(Caption, SaysGameCriterionNoiseAndVersion) {
  EXPECT_EQ(caption_text({"prisoner's dilemma (T=5,R=3,P=1,S=0)", "finite:100", 0.01}),
            "prisoner's dilemma (T=5,R=3,P=1,S=0) · finite:100 · noise 0.01 · " + version);
  EXPECT_TRUE(version.starts_with("Folk ")) << version;
  EXPECT_NE(version.find('.'), std::string::npos) << version;
}

TEST(Caption, SaysOnlyWhatApplies) {
  EXPECT_EQ(caption_text({"stag hunt", "", 0}), "stag hunt · " + version);
  EXPECT_EQ(caption_text({"", "mean", 0}), "mean · " + version);
}

TEST(Caption, TextOfOthersStaysOnItsLineAndShort) {
  EXPECT_EQ(caption_text({"a\nb\x1b[31m", "", 0}), "a\\nb\\x1b[31m · " + version);
  EXPECT_EQ(caption_text({std::string(300, 'x'), "", 0}), std::string(100, 'x') + "... · " + version);
}

TEST(Caption, LinesBreakBetweenParts) {
  const Caption caption{std::string(20, 'g'), "finite:100", 0.5};
  EXPECT_EQ(caption_lines(caption, 1000), std::vector<std::string>{caption_text(caption)});
  EXPECT_EQ(caption_lines(caption, 34),
            (std::vector<std::string>{std::string(20, 'g') + " · finite:100", "noise 0.5 · " + version}));
  EXPECT_EQ(caption_lines(caption, 0).size(), 4U);
}

}  // namespace
}  // namespace folk
