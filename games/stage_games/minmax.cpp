#include <folk/games/stage_games/minmax.h>
#include <folk/games/stage_games/reply_polytope.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace folk {
namespace {

MixedAction scaled(std::vector<Rational> weights, const Rational& sum) {
  for (Rational& weight : weights) weight /= sum;
  return weights;
}

/// The first pure action that serves as well as the mixture, where there is one: easier to read.
template <class Serves>
void prefer_pure(MixedAction& mixture, Serves serves) {
  for (std::size_t action = 0; action < mixture.size(); ++action)
    if (MixedAction pure = pure_action(mixture.size(), action); serves(pure)) {
      mixture = std::move(pure);
      return;
    }
}

}  // namespace

Minmax minmax(const StageGame& game, Seat seat) {
  // With A the raised payoffs, the largest sum of a y >= 0 with A y <= 1 is 1 over the value of the game A.
  const Rational raise = raise_to_positive(game, seat);
  ReplyPolytope polytope(own_payoffs(game, seat, raise));
  polytope.maximise_sum();
  const auto weights = polytope.point();
  const Rational sum = std::accumulate(weights.begin(), weights.end(), Rational(0));
  Minmax found{pure_minmax(game, seat), 1 / sum - raise, scaled(weights, sum), scaled(polytope.dual(), sum)};
  prefer_pure(found.punishment, [&](const MixedAction& pure) { return most_against(game, seat, pure) == found.mixed; });
  prefer_pure(found.security, [&](const MixedAction& pure) { return guaranteed(game, seat, pure) == found.mixed; });
  if (most_against(game, seat, found.punishment) != found.mixed ||
      guaranteed(game, seat, found.security) != found.mixed)
    throw std::logic_error("a minmax value was not proved by its two mixtures");
  return found;
}

Rational most_against(const StageGame& game, Seat seat, const MixedAction& opponent) {
  const auto replies = action_payoffs(game, seat, opponent);
  return *std::max_element(replies.begin(), replies.end());
}

Rational guaranteed(const StageGame& game, Seat seat, const MixedAction& own) {
  const std::size_t opponents = game.actions(other(seat)).size();
  Rational least = 0;
  for (std::size_t theirs = 0; theirs < opponents; ++theirs) {
    const MixedAction pure = pure_action(opponents, theirs);
    const Rational value =
        expected_payoff(game, seat, seat == Seat::first ? MixedProfile{own, pure} : MixedProfile{pure, own});
    if (theirs == 0 || value < least) least = value;
  }
  return least;
}

}  // namespace folk
