#pragma once
// Is a player's play a best reply to its own beliefs? The third self-confirming notion, bounded from below by a search.

#include <folk/analysis/beliefs/belief_record.h>
#include <folk/games/payoffs.h>
#include <folk/games/progress.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace folk {

/// How far and how wide own_belief_gaps searches.
struct OwnBeliefSearch {
  Payoffs payoffs;
  unsigned threads = 1;
  std::size_t depth = 6;                 ///< h: rounds in which own moves are freely chosen, 1 to 12
  std::size_t beam = 1;                  ///< sequences of a round that are played out to the end
  std::uint64_t most_thoughts = 35'000;  ///< no further rounds are searched once the player was asked this often
  std::vector<std::uint64_t> rounds{};   ///< of the path, 1-based; empty: all
};

/// The largest gain that was found, and how it is had. The witness is empty where the gain is 0.
struct OwnBeliefGap {
  double gain = 0;
  std::uint64_t round = 0;            ///< in which the deviation begins, 1-based; the history is the path before it
  std::vector<Move> own_moves{};      ///< h of them from that round on (fewer at the end); own play follows
  std::vector<Move> believed{};       ///< what the player held likelier in each of these rounds
  double own_value = 0;               ///< what it expects from that round on when it goes on as it does
  double best_value = 0;              ///< what it expects of the deviation; gain is the difference
  std::uint64_t searched_rounds = 0;  ///< how many rounds of the path were searched before the thoughts ran out
  /// Of a planned search, by the rounds of the path: what another move gains there; 0 in rounds not asked.
  std::vector<double> gains{};
};

/// The asked rounds of paths of one length, 0-based and ascending; all where none is asked. Throws UsageError for paths
/// of different lengths and a round that they do not have.
std::vector<std::size_t> asked_rounds(const std::vector<BeliefMatch>& paths, const std::vector<std::uint64_t>& asked);

/// Notion (c): the player's own belief model is the opponent that after every history plays the move which the player,
/// told that history, holds likelier. For rounds t of a path the player stands in the true history before t; from there
/// on its subjective world is deterministic, and the best of its own move sequences of h rounds, followed by its own
/// play to the end, is compared with its own play from t on. Values are totals over the rounds t to T of finite:T,
/// T being the length of the paths; a history of probability 1 is taken for granted, so that gains are as measured from
/// the start (for a path that was sampled they hold given its history).
///
/// The result is a LOWER BOUND on what a best reply to these beliefs gains, for the reasons: sequences are h rounds
/// long; of a round's 2^h only the 8 beam that earn most in their h rounds are played on for another h/2 rounds
/// (rounded up), and of these the best `beam` to the end; rounds are taken in an order that spreads over the path (1,
/// T/2, T/4, 3T/4, ...) until most_thoughts are spent, or no round left can gain more. (Sequences that begin with the
/// player's own move are left to the next round's search where the path goes on as was believed.)
///
/// `player` against several opponents at once, one path each: equal histories are thought through once, and all that is
/// asked at the same time is asked together (Player::think_together). Nothing for a player that draws random numbers
/// (Strategy::deterministic) or holds no beliefs. The result depends on no number of threads. `progress` is told the
/// finished share, 0 to 1.
/// Throws UsageError for paths of different lengths, a depth, beam or round out of range, Cancelled, and what the
/// players throw.
std::vector<std::optional<OwnBeliefGap>> own_belief_gaps(const Strategy& player, const std::vector<BeliefMatch>& paths,
                                                         const OwnBeliefSearch& search,
                                                         const Progress& progress = nullptr);

}  // namespace folk
