#pragma once
// Policies of the particle world as files: safetensors, Folk's own and those of the published program.
//
// Folk's: metadata "format": "folk-mpe-1", "scenario", "side" ("predators" or "prey"), "squash" ("tanh" or "clamp") and
// notes on how it was made; tensors agentI.fcK.weight [outputs, inputs] and agentI.fcK.bias [outputs] for each agent I
// of the side (0, 1, 2; the prey is 0) and layer K = 1, 2, ... An agent that normalises what it observes has
// agentI.norm.weight, .bias, .mean and .variance [inputs] too: (x - mean) / sqrt(variance + 1e-5) * weight + bias. The
// published program's: in_fn.weight, in_fn.bias, in_fn.running_mean, in_fn.running_var [inputs], fc1, fc2, fc3; the
// widths tell what it is for, predators share it.

#include <folk/mpe/network/policy_network.h>
#include <folk/mpe/players/player.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

inline constexpr std::string_view policy_format = "folk-mpe-1";

/// No policy file that Folk reads is larger than this.
inline constexpr std::size_t largest_policy_file = std::size_t{64} << 20U;

struct Policy {
  std::string scenario;
  Side side = Side::predators;
  std::vector<PolicyNetwork> networks;       ///< one an agent of the side, or one that they share
  std::map<std::string, std::string> notes;  ///< how it was made
};

/// Reads the bytes of a policy file; `source` (a path) is what messages call them. Throws InputFileError "source: what;
/// mend" for what is no such file, other widths than any scenario has, tensors that are missing, too many or of another
/// shape or type, numbers that are not finite and variances below 0.
Policy parse_policy(std::string_view bytes, const std::string& source);
Policy read_policy(const std::filesystem::path& path);

/// The bytes of Folk's own form, which parse_policy reads back to the same policy. Throws UsageError when it would not.
std::string policy_bytes(const Policy& policy);

/// Writes policy_bytes at once or not at all. Throws UsageError, EnvironmentError.
void write_policy(const std::filesystem::path& path, const Policy& policy);

/// The player of a policy. Throws UsageError when it is for another side or scenario.
Controller policy_controller(std::string name, Policy policy, Side side, const Scenario& scenario);

/// A freshly initialised network of the online learners' shape for each agent of a side: what plays at random level.
Policy untrained_policy(const Scenario& scenario, Side side, std::uint64_t seed, std::size_t hidden = 64);

std::string_view to_string(Side side);

}  // namespace folk::mpe
