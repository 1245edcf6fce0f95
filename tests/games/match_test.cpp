#include <folk/games/match.h>
#include <folk/games/random.h>
#include <folk/games/transcript.h>
#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

namespace folk {
namespace {

/// Plays a fixed word over and over and writes down what it is told.
struct Scripted {
  std::string word;
  std::string own{};
  std::string theirs{};

  Move move() const { return word[own.size() % word.size()] == 'C' ? Move::C : Move::D; }
  void observe(Move mine, Move other_move) {
    own += to_char(mine);
    theirs += to_char(other_move);
  }
};

/// Repeats the opponent's last move, C first.
struct Echo {
  Move last = Move::C;

  Move move() const { return last; }
  void observe(Move, Move theirs) { last = theirs; }
};

template <class A, class B, class Slips>
Transcript played(A& first, B& second, std::uint64_t rounds, Slips slips) {
  Transcript transcript;
  play_match(first, second, rounds, slips, [&](Move a, Move b) { transcript.append(a, b); });
  return transcript;
}

TEST(Match, PlaysWithoutNoise) {
  Scripted scripted{"CCD"};
  Echo echo;
  const Transcript transcript = played(scripted, echo, 7, NoNoise{});
  EXPECT_EQ(transcript.moves(Seat::first), "CCDCCDC");
  EXPECT_EQ(transcript.moves(Seat::second), "CCCDCCD");
  EXPECT_EQ(scripted.own, "CCDCCDC");
  EXPECT_EQ(scripted.theirs, "CCCDCCD");
}

TEST(Match, NoRoundsTellNothing) {
  Scripted a{"C"};
  Scripted b{"D"};
  EXPECT_EQ(played(a, b, 0, NoNoise{}).rounds(), 0U);
  EXPECT_EQ(a.own, "");
}

TEST(Match, NoiseFlipsAndBothLearnTheMoveReallyPlayed) {
  Scripted a{"C"};
  Scripted b{"D"};
  // First player, second player, round by round.
  std::deque<bool> slips{false, false, true, false, false, true, true, true};
  const Transcript transcript = played(a, b, 4, [&] {
    const bool slip = slips.front();
    slips.pop_front();
    return slip;
  });
  EXPECT_TRUE(slips.empty());
  EXPECT_EQ(transcript.moves(Seat::first), "CDCD");
  EXPECT_EQ(transcript.moves(Seat::second), "DDCC");
  EXPECT_EQ(a.own, "CDCD");
  EXPECT_EQ(a.theirs, "DDCC");
  EXPECT_EQ(b.own, "DDCC");
  EXPECT_EQ(b.theirs, "CDCD");
}

TEST(Match, AnEchoAnswersTheFlippedMove) {
  Scripted always{"C"};
  Echo echo;
  int asked = 0;
  const Transcript transcript = played(always, echo, 3, [&] { return asked++ == 2; });  // the first player in round 1
  EXPECT_EQ(transcript.moves(Seat::first), "CDC");
  EXPECT_EQ(transcript.moves(Seat::second), "CCD");
}

TEST(Match, SameKeySameNoise) {
  const auto run = [] {
    RandomStream noise({.seed = 7, .pair = 3, .repetition = 2, .role = 2});
    Scripted a{"CD"};
    Scripted b{"CCD"};
    const Transcript transcript = played(a, b, 500, [&] { return noise.chance(0.1); });
    return transcript.moves(Seat::first) + transcript.moves(Seat::second);
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace folk
