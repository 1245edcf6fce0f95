#pragma once
// A transformer as the predators of the particle world, and its beliefs under intervention.

#include <folk/mpe/players/player.h>
#include <folk/mpe/players/transformer_thinker.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace folk::mpe {

/// What stands in the present belief token instead of the belief.
enum class BeliefForcing {
  none,           ///< the belief itself
  truth,          ///< what the prey will do in this very step
  other_episode,  ///< what the prey will do in this step of the next episode of the block
  zero
};

std::string_view to_string(BeliefForcing forcing);

/// What a transformer thought in one step of one episode.
struct ThoughtRecord {
  std::uint64_t episode = 0;  ///< its number among the seed's
  std::size_t step = 0;
  std::array<float, 2> belief{};  ///< that it formed
  /// How far its actions are from those on its own belief: mean Euclidean distance over the predators; 0 where nothing
  /// is forced.
  double change = 0;
};

/// How it is asked to play.
struct TransformerPlay {
  std::optional<double> target;  ///< the asked return, unscaled; otherwise the policy's own
  BeliefForcing forcing = BeliefForcing::none;

  /// For `truth` and `other_episode`: whom it plays. It is asked a second time, and must draw from the moment alone.
  std::optional<Controller> prey;

  /// Is told of every thought; several threads may call it at once, each of other episodes.
  std::function<void(const ThoughtRecord&)> witness = nullptr;
};

/// The predators that a transformer moves. Throws UsageError, naming `name`, when it is for another scenario, when a
/// belief is to be forced of which the action is no function, or without the prey that this takes.
Controller transformer_controller(std::string name, std::shared_ptr<const TransformerMind> mind,
                                  const Scenario& scenario, TransformerPlay play = {});

}  // namespace folk::mpe
