#pragma once
// Trajectories as a folder of .npy files, one array a kind of number, as loaders of offline multi-agent data take them.
//
//   actions.npy           [N, T]     the player's moves, C = 0 and D = 1
//   opponent_actions.npy  [N, T]     the opponent's
//   rewards.npy           [N, T]     payoff of each round to the player
//   observations.npy      [N, T, 5]  one of five set to 1: no round yet, or the last one's (own, their) CC CD DC DD
//   names.json                       {"players": [N names], "opponents": [N names]}
//
// N trajectories of T rounds each. The last two files follow from the others or may be unknown: both may be missing.

#include <folk/sct/data/trajectory.h>

#include <filesystem>
#include <vector>

namespace folk::sct {

/// Reads a folder; without names.json players and opponents have no name. The numbers may have any type and order of
/// npy_file.h.
/// Throws InputFileError "FILE: what; mend", with the index where there is one: for a file that is missing, cannot be
/// read, disagrees with actions.npy in N or T, or holds a move other than 0 and 1, a reward that is not finite or an
/// observation that is not what the moves of the round before make it; and for no trajectory at all.
std::vector<Trajectory> read_data_folder(const std::filesystem::path& folder);

/// Writes all five files, each at once or not at all, and makes the folder when there is none: moves as <i4, rewards as
/// <f8, observations as <f4. (Bytes in a name that are not UTF-8 become U+FFFD.)
/// Throws UsageError when there is no trajectory or they differ in length, EnvironmentError when a file cannot be
/// written.
void write_data_folder(const std::filesystem::path& folder, const std::vector<Trajectory>& trajectories);

}  // namespace folk::sct
