#pragma once
// The moves of one match, two bits a round.

#include <folk/games/outcome.h>
#include <folk/games/seat.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace folk {

/// What both players really played, from round 0 on. 32 rounds take 8 bytes.
class Transcript {
public:
  void append(Move first, Move second) {
    const std::size_t shift = 2 * (rounds_ % 32);
    if (shift == 0) words_.push_back(0);
    const std::size_t outcome = Outcome{first, second}.index();
    words_.back() |= std::uint64_t{outcome} << shift;
    ++rounds_;
    ++counts_[outcome];
  }

  std::size_t rounds() const { return rounds_; }
  Move first(std::size_t round) const { return outcome(round).own; }
  Move second(std::size_t round) const { return outcome(round).theirs; }
  Move move(Seat seat, std::size_t round) const { return seat == Seat::first ? first(round) : second(round); }

  /// What was played in a round, as the first player sees it.
  Outcome outcome(std::size_t round) const { return all_outcomes[(words_[round / 32] >> (2 * (round % 32))) & 3U]; }

  /// How often each outcome occurred, the first player's move first: CC, CD, DC, DD.
  const std::array<std::uint64_t, 4>& counts() const { return counts_; }

  /// The moves of one player as people write them: "CCDC".
  std::string moves(Seat seat) const {
    std::string text;
    text.reserve(rounds_);
    for (std::size_t t = 0; t < rounds_; ++t) text += to_char(move(seat, t));
    return text;
  }

private:
  std::vector<std::uint64_t> words_;
  std::array<std::uint64_t, 4> counts_{};
  std::size_t rounds_ = 0;
};

}  // namespace folk
