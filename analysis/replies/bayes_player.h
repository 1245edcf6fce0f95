#pragma once
// bayes(SPEC): the player who knows the roster and learns in play which of its members is met.

#include <folk/analysis/replies/opponent_prior.h>
#include <folk/strategies/registry.h>
#include <folk/strategies/strategy.h>

#include <optional>
#include <string>
#include <vector>

namespace folk {

/// Rounds that bayes(SPEC) looks ahead where it cannot play exactly and no depth is given; and the most it can.
inline constexpr unsigned default_lookahead = 5;
inline constexpr unsigned most_lookahead = 10;

/// Members of a roster that is still played exactly without being told otherwise.
inline constexpr std::size_t most_exact_members = 100;

/// A player with beliefs (Player::belief). Once its opponent has played what no member of the roster would, it believes
/// 0.5 and repeats the opponent's last move for the rest of the match.
///
/// Without `depth` it is Bayes-optimal (BayesReply, made at the start of the first match and shared by all players of
/// this strategy): its matches must be under finite:T, anything else is a UsageError that says so. With `depth` it
/// looks that many rounds ahead on the posterior (fewer at the end of finite:T) under any criterion and plays the move
/// that earns more in them, C where they are as good up to rounding.
///
/// `name` must state the depth. Throws UsageError when a member of the roster is an opaque player or the depth is 0 or
/// above most_lookahead.
Strategy bayes_strategy(std::string name, std::vector<Strategy> roster, std::optional<unsigned> depth);

/// The player who looks ahead on what may have weights, classes and slips in it.
Strategy bayes_strategy(std::string name, OpponentPrior prior, unsigned depth);

/// Adds "bayes(SPEC)", "bayes(SPEC;depth=H)" and "bayes(SPEC;depth=H;slip=E)", SPEC being a roster of what the registry
/// knows now, whose items may have weights (read_prior). A roster that mixes, has weights, slips, or has more than
/// most_exact_members members gets the depth default_lookahead if none is given, and the strategy's name states it:
/// bayes(gtft(0.3),all_d) is called bayes(gtft(0.3),all_d;depth=5).
void add_bayes(Registry& registry);

}  // namespace folk
