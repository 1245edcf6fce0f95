#pragma once
// A trained transformer of the particle world: its network, how it sees observations, which return it is asked for.
//
// As a file: safetensors; metadata "format": "folk-mpe-transformer-1", "scenario", "loss_mode", "scale_mean" and
// "scale_deviation" (a number a predator), "return_scale", "return_target", the architecture's keys as in policies of
// repeated games (sct/network/network_file.h), "checksum", and notes on how it was made; tensors as the published
// program names them.

#include <folk/mpe/network/observation_scale.h>
#include <folk/mpe/world/scenario.h>
#include <folk/sct/network/architecture.h>
#include <folk/sct/policy/policy.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

inline constexpr std::string_view transformer_format = "folk-mpe-transformer-1";

struct TransformerPolicy {
  std::string scenario;
  sct::Architecture architecture;
  sct::LossMode mode = sct::LossMode::teacher;
  std::vector<float> parameters;  ///< in the order of sct::ParameterLayout
  ObservationScale scale;
  double return_scale = 100;                 ///< returns are divided by it before they are embedded
  double return_target = 0;                  ///< the return it is asked for, unscaled
  std::map<std::string, std::string> notes;  ///< how it was made
};

/// The stream of a scenario: all its predators, their observations, continuous actions of two numbers, a time row for
/// each step and one more, as the published program has it. All else is left as `base` has it.
sct::Architecture particle_architecture(const Scenario& scenario, sct::Architecture base = {});

/// Reads a file's bytes; `source` (a path) is what messages call them. Throws InputFileError "source: what; mend" for
/// anything but a whole policy of a scenario that Folk knows.
TransformerPolicy parse_transformer_policy(std::string_view bytes, const std::string& source);

/// Throws UsageError for a policy that parse_transformer_policy would refuse.
std::string transformer_policy_bytes(const TransformerPolicy& policy);

}  // namespace folk::mpe
