#pragma once
// One match of two players, round by round, with its outcomes and guesses added up.

#include <folk/analysis/play/pair_result.h>
#include <folk/analysis/play/sampling.h>
#include <folk/games/match_key.h>
#include <folk/games/seat.h>
#include <folk/strategies/strategy.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace folk {

/// Two strategies that meet again and again.
struct Contest {
  const Strategy* first = nullptr;
  const Strategy* second = nullptr;
  std::uint64_t pair = 0;  ///< the number of the pair in the random keys
  bool once = false;       ///< both are deterministic and nothing slips: one match says all

  bool operator==(const Contest&) const = default;
};

/// Throws UsageError when the contest takes more than 10^8 rounds.
void check_length(const Contest& contest, const Sampling& sampling);

/// A table at which one contest is played, one match after the other.
class PlayedMatch {
public:
  /// Neither `contest`'s strategies nor `sampling` may go before this.
  PlayedMatch(const Contest& contest, const Sampling& sampling);

  const Contest& contest() const { return contest_; }

  /// A new match begins, with the same players: the one with this number. Whatever is drawn has its
  /// match_key(seed, pair, repetition, role).
  void start(std::uint64_t repetition);

  std::uint64_t rounds_left() const { return rounds_left_; }

  void play_round();

  Player& player(Seat seat) const { return *players_[index(seat)]; }

  /// Of the rounds played in this match.
  OutcomeWeights weights() const;
  Guesses guesses(Seat seat) const;

private:
  void judge_belief(Seat seat, Move theirs);

  Contest contest_;
  const Sampling& sampling_;
  std::array<std::unique_ptr<Player>, 2> players_;
  std::array<bool, 2> may_believe_{};  // machines never do
  double scale_ = 1;                   // what a round weighs is scale_ * continuation_^(t-1)
  double continuation_ = 1;

  std::optional<RandomStream> noise_;
  std::uint64_t rounds_left_ = 0;
  double weight_ = 1;  // of the coming round; this and what it is added to still want scale_
  OutcomeWeights weights_{};
  std::array<Guesses, 2> guesses_{};
};

}  // namespace folk
