#pragma once
// Recorded episodes as CSV: the form in which this world is compared with other programs, and kept.
//
// A header line, then a row a moment: `episode`, `t` and the numbers of recording_columns.h. Row t = 0 is the reset; a
// later one holds the action that led to it, then the state, observations and rewards it led to. A file may hold
// several episodes, one after the other.

#include <folk/mpe/evaluation/episode_record.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// Reads recorded episodes of simple_tag or simple_world, whichever has these columns; they may stand in any order.
/// `source` (a path) is what messages call the text; `rule` is how rewards were written down. The length of each
/// episode becomes its scenario's. Throws InputFileError "source:line: what; mend" for a column that is missing, given
/// twice or not of the scenario (it would not be looked at, and a replay that says all is the same must have looked at
/// all), a row of another length, what is no number or beyond largest_action, rows whose t does not count up from 0, an
/// episode without a step, a landmark that moves and an action that led to a reset.
std::vector<EpisodeRecord> parse_recording(std::string_view text, const std::string& source,
                                           RewardRule rule = RewardRule::program);
std::vector<EpisodeRecord> read_recording(const std::filesystem::path& path, RewardRule rule = RewardRule::program);

/// The text of some episodes, which parse_recording reads back to the same numbers: each is the shortest decimal (at
/// most 17 digits) of its double. Throws UsageError when there is none or they are of different scenarios.
std::string recording_text(std::span<const EpisodeRecord> episodes);

/// Writes recording_text at once or not at all. Throws UsageError, EnvironmentError.
void write_recording(const std::filesystem::path& path, std::span<const EpisodeRecord> episodes);

}  // namespace folk::mpe
