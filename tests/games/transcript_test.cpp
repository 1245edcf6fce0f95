#include <folk/games/transcript.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <utility>
#include <vector>

namespace folk {
namespace {

RC_GTEST_PROP(Transcript, SaysWhatAPlainListSays, (const std::vector<std::pair<bool, bool>>& drawn)) {
  // Three times over, so that lengths beyond the 32 rounds of a word come up often.
  std::vector<std::pair<Move, Move>> plain;
  Transcript transcript;
  for (int copy = 0; copy < 3; ++copy)
    for (const auto& [a, b] : drawn) {
      plain.emplace_back(move_from_bit(a), move_from_bit(b));
      transcript.append(plain.back().first, plain.back().second);
    }
  RC_ASSERT(transcript.rounds() == plain.size());
  std::array<std::uint64_t, 4> counts{};
  std::string firsts;
  std::string seconds;
  for (std::size_t t = 0; t < plain.size(); ++t) {
    RC_ASSERT(transcript.first(t) == plain[t].first);
    RC_ASSERT(transcript.second(t) == plain[t].second);
    ++counts[Outcome{plain[t].first, plain[t].second}.index()];
    firsts += to_char(plain[t].first);
    seconds += to_char(plain[t].second);
  }
  RC_ASSERT(transcript.counts() == counts);
  RC_ASSERT(transcript.moves(Seat::first) == firsts);
  RC_ASSERT(transcript.moves(Seat::second) == seconds);
}

TEST(Transcript, CrossesWords) {
  for (const std::size_t rounds : {31U, 32U, 33U, 64U, 65U}) {
    Transcript transcript;
    for (std::size_t t = 0; t < rounds; ++t) transcript.append(Move::C, t + 1 == rounds ? Move::C : Move::D);
    EXPECT_EQ(transcript.moves(Seat::first), std::string(rounds, 'C'));
    EXPECT_EQ(transcript.moves(Seat::second), std::string(rounds - 1, 'D') + 'C');
  }
}

TEST(Transcript, StartsEmpty) {
  EXPECT_EQ(Transcript{}.rounds(), 0U);
  EXPECT_EQ(Transcript{}.moves(Seat::first), "");
}

}  // namespace
}  // namespace folk
