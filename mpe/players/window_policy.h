#pragma once
// Policies that act on the last steps of what all predators observed: one network for the whole team.
//
// As files: safetensors, metadata "format": "folk-mpe-window-1", "scenario", "context" (steps of the window) and notes
// on how it was made; tensors fcK.weight [outputs, inputs] and fcK.bias [outputs] for each layer K = 1, 2, ..., and
// scale.mean, scale.deviation [predators]. The inputs are context * (what the predators observe together): step after
// step, the last one at the end, in each step predator after predator, all numbers on the predator's scale; steps
// before the episode began are zeros. Between layers ReLU; tanh of the outputs are the predators' actions, two numbers
// each.

#include <folk/mpe/network/mlp.h>
#include <folk/mpe/network/observation_scale.h>
#include <folk/mpe/players/player.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

inline constexpr std::string_view window_policy_format = "folk-mpe-window-1";

struct WindowPolicy {
  std::string scenario;
  std::size_t context = 20;
  ObservationScale scale;
  MlpShape shape;
  std::vector<float> parameters;
  std::map<std::string, std::string> notes;  ///< how it was made
};

/// Numbers that all predators of a scenario observe together in a step.
std::size_t team_observation_size(const Scenario& scenario);

/// The bytes of a policy file, which parse_window_policy reads back to the same policy. Throws UsageError when it would
/// not.
std::string window_policy_bytes(const WindowPolicy& policy);

/// Reads the bytes of a policy file; `source` (a path) is what messages call them. Throws InputFileError "source: what;
/// mend" for what is no such file, widths that do not fit its scenario and context, tensors that are missing, too many
/// or of another shape or type, numbers that are not finite and deviations that are not above 0.
WindowPolicy parse_window_policy(std::string_view bytes, const std::string& source);

/// The players of a policy; all of a team look through one window. Throws UsageError when it is for another scenario;
/// its team throws that for a side other than the predators.
Controller window_controller(std::string name, WindowPolicy policy, const Scenario& scenario);

}  // namespace folk::mpe
