#pragma once
// Matches that somebody played somewhere, read from a table: what was done, and perhaps what was believed.

#include <folk/analysis/beliefs/belief_record.h>
#include <folk/games/seat.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// One match from its first round on, as the recorded player saw it. The truth of a round is the move that was made.
struct RecordedMatch {
  std::string name;
  BeliefMatch rounds;
};

/// The matches of one player, in the order in which they come up.
struct RecordedPlay {
  std::vector<RecordedMatch> matches;
  std::vector<std::string> ignored_columns;  ///< of the table: their names

  std::uint64_t rounds() const;         ///< of all matches
  std::uint64_t longest_match() const;  ///< in rounds
  bool has_beliefs() const;             ///< some round has one
};

/// Records of more rounds are refused.
inline constexpr std::uint64_t most_judged_rounds = 1'000'000;

/// A round as the player in this seat saw it; the recorded player sits in the first.
inline Outcome seen_from(Seat seat, const Outcome& round) { return seat == Seat::first ? round : round.exchanged(); }

/// Reads CSV (RFC 4180, every record a line): a header that names the columns match, round, own, theirs and perhaps
/// belief, in any order and in any case, then a line a round, in any order. Other columns are ignored.
///   match        any text
///   round        1, 2, 3, ... in each match; or 0, 1, 2, ... in all of them
///   own, theirs  one of `actions` as they stand; else C or D in any case, or 0 for C and 1 for D
///   belief       P(their C) as it was stated before the round, 0 to 1; empty where none was
/// Throws InputFileError, naming `source` and the line: for a missing or repeated column, another number of fields, a
/// field that is none of the above, a round that is missing or there twice, more than most_judged_rounds, and a table
/// without rounds.
RecordedPlay read_recorded_play(std::string_view text, const std::string& source,
                                const std::array<std::string, 2>& actions = {"C", "D"});

}  // namespace folk
