#pragma once
// The names under which players of the particle world are known.
//
//   still  random  random(program)  blend(P[;PLAYER][;shared])   either side; blend: PLAYER with probability P, else
//                                                                random(program) (default PLAYER: released or expert)
//   lead_pursuit  greedy_pursuit  expert  medium                 predators
//   expert_maddpg                                                predators that were trained against the prey maddpg
//   released  maddpg                                             the prey
//   untrained(SEED)                                              either side, a freshly initialised network
//   exec:"CMD"                                                   a program on a pipe
//   anything else                                                a policy file (policy_file.h)

#include <folk/mpe/players/player.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// The controller of a name. Case, blanks, '_' and '-' do not matter in names; they do in paths and commands. `data`:
/// the folder of the shipped policies. Throws UsageError for a name that makes no sense for this side, with the nearest
/// ones, and InputFileError for a file that cannot be read or is of another scenario or side.
Controller controller(std::string_view spec, Side side, const Scenario& scenario, const std::filesystem::path& data);

/// The names of a side's players: "still", or with what they take: "blend(P)".
const std::vector<std::string>& known_names(Side side);

/// A comma list of names taken apart; commas inside () or quotes do not split. Throws UsageError on an empty one.
std::vector<std::string> split_names(std::string_view list);

}  // namespace folk::mpe
