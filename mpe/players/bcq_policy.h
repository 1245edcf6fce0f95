#pragma once
// Policies that take the best of what the data would do: batch-constrained Q-learning (Fujimoto, Meger & Precup 2019).
//
// The file is safetensors with metadata "format": "folk-mpe-bcq-1", "scenario", "candidates", "perturbation" and notes
// on how it was made; tensors agentI.decoder.fcK, agentI.perturbation.fcK and agentI.critic.fcK, each .weight [outputs,
// inputs] and .bias [outputs], for each predator I = 0, 1, 2 and layer K = 1, 2, ...

#include <folk/mpe/network/mlp.h>
#include <folk/mpe/players/player.h>
#include <folk/mpe/players/policy_tensors.h>
#include <folk/mpe/world/random_stream.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

inline constexpr std::string_view bcq_policy_format = "folk-mpe-bcq-1";

/// What a predator chooses with; tanh follows where it is said.
struct BcqNetworks {
  StoredNetwork decoder;       ///< (observation, latent numbers) to an action, tanh
  StoredNetwork perturbation;  ///< (observation, action) to a shift of it, tanh
  StoredNetwork critic;        ///< (observation, action) to a value
};

struct BcqPolicy {
  std::string scenario;
  std::vector<BcqNetworks> networks;         ///< one a predator
  std::size_t candidates = 100;              ///< actions of which the best is taken
  double perturbation = 0.05;                ///< the largest shift of each of an action's numbers
  std::map<std::string, std::string> notes;  ///< how it was made
};

/// Candidate actions in the making.
template <class S>
struct CandidateTape {
  MlpTape<S> decoder;       ///< its input [rows, observed + latent] is to be filled in
  MlpTape<S> perturbation;  ///< its input: [observation | action as decoded]
  Matrix<S> squashed;       ///< scratch
  Matrix<S> shifts;         ///< tanh of the perturbation's output [rows, 2]
  Matrix<S> judged;         ///< the result [rows, observed + 2]: [observation | candidate], what a critic judges
};

/// A network where its numbers lie.
template <class S>
struct NetworkView {
  const MlpShape& shape;
  const S* parameters;
};

/// The candidates of tape.decoder.input(): tanh of the decoder, plus `most` times tanh of the perturbation, cut to
/// [-1, 1].
template <class S>
void propose(NetworkView<S> decoder, NetworkView<S> perturbation, S most, CandidateTape<S>& tape);

/// Latent numbers that candidates are decoded from: standard normal, cut to [-0.5, 0.5].
void draw_latent(RandomStream& random, float* numbers, std::size_t count);

/// Reads the bytes of a policy file; `source` (a path) is what messages call them. Throws InputFileError "source: what;
/// mend" for what is no such file, widths that do not fit the scenario, tensors that are missing, too many or of
/// another shape or type, and numbers that are not finite or out of range.
BcqPolicy parse_bcq_policy(std::string_view bytes, const std::string& source);

/// The bytes that parse_bcq_policy reads back to the same policy. Throws UsageError when it would not.
std::string bcq_policy_bytes(const BcqPolicy& policy);

/// The predators that play it: each draws candidates from its decoder, shifts them, and takes the one its critic values
/// most. Throws UsageError when it is for another scenario.
Controller bcq_controller(std::string name, BcqPolicy policy, const Scenario& scenario);

}  // namespace folk::mpe
