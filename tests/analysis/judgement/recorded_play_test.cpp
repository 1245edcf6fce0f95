#include <folk/analysis/judgement/recorded_play.h>
#include <folk/games/error.h>
#include <gtest/gtest.h>

#include <string>

namespace folk {
namespace {

std::string moves(const RecordedMatch& match) {
  std::string text;
  for (const auto& round : match.rounds) text += std::string{to_char(round.own), to_char(round.theirs), ' '};
  return text;
}

TEST(RecordedPlay, IsReadWhateverTheOrderOfColumnsAndRows) {
  const auto play = read_recorded_play(
      "\xEF\xBB\xBFTheirs,time,OWN,match,round,belief\r\nC,9:00,D,b,2,\r\n1,9:01,0,b,1,0.25\r\n\r\nd,9:02,c,\"a,1\",1,"
      "1\r\n",
      "log.csv");
  ASSERT_EQ(play.matches.size(), 2U);
  EXPECT_EQ(play.matches[0].name, "b");
  EXPECT_EQ(moves(play.matches[0]), "CD DC ");
  EXPECT_EQ(play.matches[0].rounds[0].belief, 0.25);
  EXPECT_EQ(play.matches[0].rounds[0].truth, 0);
  EXPECT_FALSE(play.matches[0].rounds[1].belief);
  EXPECT_EQ(play.matches[1].name, "a,1");
  EXPECT_EQ(moves(play.matches[1]), "CD ");
  EXPECT_EQ(play.ignored_columns, std::vector<std::string>{"time"});
  EXPECT_EQ(play.rounds(), 3U);
  EXPECT_EQ(play.longest_match(), 2U);
  EXPECT_TRUE(play.has_beliefs());
}

TEST(RecordedPlay, MayCountFromZero) {
  const auto play = read_recorded_play("match,round,own,theirs\nx,0,C,C\nx,1,C,D\ny,0,D,D\n", "log.csv");
  EXPECT_EQ(moves(play.matches[0]), "CC CD ");
  EXPECT_FALSE(play.has_beliefs());
}

TEST(RecordedPlay, KnowsTheNamesOfTheGame) {
  const std::array<std::string, 2> names{"Stag", "Hare"};
  EXPECT_EQ(moves(read_recorded_play("match,round,own,theirs\n1,1,Stag,Hare\n1,2,D,0\n", "f", names).matches[0]),
            "CD DC ");
  // Names count before letters and numbers: here 1 is the first move.
  const std::array<std::string, 2> bits{"1", "0"};
  EXPECT_EQ(moves(read_recorded_play("match,round,own,theirs\n1,1,1,0\n", "f", bits).matches[0]), "CD ");
}

TEST(RecordedPlay, SaysInWhichLineItMakesNoSense) {
  const auto refused = [](const std::string& text, const std::string& why) {
    try {
      read_recorded_play(text, "log.csv");
      ADD_FAILURE() << text;
    } catch (const InputFileError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  const std::string header = "match,round,own,theirs,belief\n";
  refused("", "log.csv: no recorded play");
  refused(header, "log.csv: no round after the header");
  refused("match,round,own\n", "log.csv:1: no column 'theirs'");
  refused("match,round,own,theirs,Own\n", "log.csv:1: column 'own' is there twice");
  refused(header + "1,1,C,C\n", "log.csv:2: 4 fields: expected 5");
  refused(header + ",1,C,C,\n", "log.csv:2: no match named");
  refused(header + "1,one,C,C,\n", "log.csv:2: round 'one'");
  refused(header + "1,-1,C,C,\n", "log.csv:2: round '-1'");
  refused(header + "1,1000001,C,C,\n", "log.csv:2: round '1000001'");
  refused(header + "1,1,C,X,\n", "log.csv:2: theirs 'X': expected C or D, or 0 for C and 1 for D");
  refused(header + "1,1,,C,\n", "log.csv:2: own ''");
  refused(header + "1,1,C,C,1.5\n", "log.csv:2: belief");
  refused(header + "1,1,C,C,nan\n", "log.csv:2: belief");
  refused(header + "1,1,C,C,\n1,3,C,C,\n", "log.csv:3: round 3 of match '1': round 2 is missing");
  refused(header + "1,2,C,C,\n", "log.csv:2: round 2 of match '1': round 1 is missing");
  refused(header + "1,0,C,C,\n2,1,C,C,\n", "log.csv:3: round 1 of match '2': round 0 is missing");
  refused(header + "1,1,C,C,\n2,1,C,C,\n1,1,C,C,\n", "log.csv:4: round 1 of match '1' is there twice, also in line 2");
  refused(std::string("\0\x01\x7f\xff", 4), "log.csv:1: no column 'match'");
}

TEST(RecordedPlay, HasAnEnd) {
  std::string text = "match,round,own,theirs\n";
  for (std::uint64_t t = 0; t <= most_judged_rounds; ++t) text += "1,0,C,C\n";
  EXPECT_THROW(read_recorded_play(text, "log.csv"), InputFileError);
}

}  // namespace
}  // namespace folk
