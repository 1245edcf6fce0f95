#pragma once
// A player whose actions are disturbed.

#include <folk/mpe/players/player.h>

namespace folk::mpe {

/// Adds to each action a normal number of mean 0 and standard deviation `sigma`, of its own for each episode, step,
/// agent and axis, and cuts the sum to [-1, 1]: noise that makes data diverse (Pan et al. 2022). With sigma = 0 it is
/// the controller itself. Throws UsageError unless 0 <= sigma <= 100.
Controller noisy(Controller controller, double sigma);

}  // namespace folk::mpe
