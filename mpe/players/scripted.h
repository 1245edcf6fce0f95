#pragma once
// Players that follow a rule: still, at random, in pursuit, and two players mixed by a coin.

#include <folk/games/rational.h>
#include <folk/mpe/players/player.h>

namespace folk::mpe {

/// (0, 0) for ever.
Controller still_player();

/// How a random action is drawn.
enum class RandomRule {
  uniform,  ///< uniform in [-1, 1]^2, whatever is observed
  program   ///< the published program's: drawn again while it would lead further out of [-1, 1]^2
};
Controller random_player(RandomRule rule = RandomRule::uniform);

/// Each predator u = clip(3 (p_prey + 0.2 v_prey - p - 0.15 v), -1, 1): towards where the prey will be.
Controller lead_pursuit();

/// Each predator u = clip(3 (p_prey - p), -1, 1): towards where the prey is now.
Controller greedy_pursuit();

/// Who shares a coin in a blend.
enum class Coin {
  episode,  ///< one toss a step and episode, as the paper's text
  batch     ///< one toss a step for all episodes of a seed, as the published program's evaluation
};

/// At each step with probability p the one, otherwise random by the published program's rule (Li et al., arXiv
/// 2310.04579, section 3, where the text says uniform).
/// Throws UsageError unless 0 <= p <= 1, and for a blend of a blend, where the two coins would be one.
Controller blend(const Rational& p, Controller one, Coin coin = Coin::episode);

/// The same for the decimal that a double stands for.
Controller blend(double p, Controller one, Coin coin = Coin::episode);

}  // namespace folk::mpe
