#include <folk/games/error.h>
#include <folk/games/stage_games/mixed_profile.h>

#include <algorithm>

namespace folk {
namespace {

const Rational& payoff(const StageGame& game, Seat seat, std::size_t own, std::size_t theirs) {
  return seat == Seat::first ? game.payoff(seat, own, theirs) : game.payoff(seat, theirs, own);
}

void check(const StageGame& game, Seat seat, const MixedAction& mix) {
  if (mix.size() != game.actions(seat).size())
    throw UsageError("a mixed action gives " + std::to_string(mix.size()) + " probabilities for " +
                     std::to_string(game.actions(seat).size()) + " actions: give one for each");
  Rational sum = 0;
  for (const Rational& probability : mix) {
    if (probability < 0)
      throw UsageError("a mixed action has the probability " + to_text(probability) + ": give none below 0");
    sum += probability;
  }
  if (sum != 1) throw UsageError("the probabilities of a mixed action add up to " + to_text(sum) + ": make it 1");
}

}  // namespace

MixedAction pure_action(std::size_t actions, std::size_t action) {
  if (action >= actions)
    throw UsageError("there is no action " + std::to_string(action) + ": count " + std::to_string(actions) +
                     " actions from 0");
  MixedAction mix(actions);
  mix[action] = 1;
  return mix;
}

std::vector<Rational> action_payoffs(const StageGame& game, Seat seat, const MixedAction& opponent) {
  check(game, other(seat), opponent);
  std::vector<Rational> payoffs(game.actions(seat).size());
  for (std::size_t own = 0; own < payoffs.size(); ++own)
    for (std::size_t theirs = 0; theirs < opponent.size(); ++theirs)
      payoffs[own] += opponent[theirs] * payoff(game, seat, own, theirs);
  return payoffs;
}

Rational expected_payoff(const StageGame& game, Seat seat, const MixedProfile& profile) {
  const MixedAction& own = profile.of(seat);
  check(game, seat, own);
  const auto payoffs = action_payoffs(game, seat, profile.of(other(seat)));
  Rational sum = 0;
  for (std::size_t i = 0; i < own.size(); ++i) sum += own[i] * payoffs[i];
  return sum;
}

Rational largest_gain(const StageGame& game, Seat seat, const MixedProfile& profile) {
  const auto payoffs = action_payoffs(game, seat, profile.of(other(seat)));
  return *std::max_element(payoffs.begin(), payoffs.end()) - expected_payoff(game, seat, profile);
}

bool is_equilibrium(const StageGame& game, const MixedProfile& profile) {
  return largest_gain(game, Seat::first, profile) == 0 && largest_gain(game, Seat::second, profile) == 0;
}

Rational pure_minmax(const StageGame& game, Seat seat) {
  const std::size_t own_actions = game.actions(seat).size();
  const std::size_t their_actions = game.actions(other(seat)).size();
  Rational least = 0;
  for (std::size_t theirs = 0; theirs < their_actions; ++theirs) {
    Rational best = payoff(game, seat, 0, theirs);
    for (std::size_t own = 1; own < own_actions; ++own) best = std::max(best, payoff(game, seat, own, theirs));
    if (theirs == 0 || best < least) least = best;
  }
  return least;
}

}  // namespace folk
