#pragma once
// Strategies as values: what one remembers, its move, and what a round does to its memory. A rule whose memory fits the
// state of a machine can be one; any other is played.

#include <folk/games/random.h>
#include <folk/strategies/machine.h>
#include <folk/strategies/player.h>
#include <folk/strategies/strategy.h>

#include <array>
#include <bit>
#include <concepts>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace folk {

/// A default-made one stands before the first round.
template <class R>
concept Rule = std::copyable<R> && std::default_initializable<R> && requires(R rule, Move own, Move theirs) {
  rule.observe(own, theirs);
};

/// A rule that mixes: it says P(C) instead of its move.
template <class R>
concept MixingRule = Rule<R> && requires(const R& rule) {
  { rule.cooperation() } -> std::same_as<double>;
};

/// A small value, byte by byte, as (a part of) a state; equal values are equal states.
template <class T>
State bytes_of(const T& value) {
  static_assert(sizeof(T) <= sizeof(State) && std::has_unique_object_representations_v<T>);
  const auto bytes = std::bit_cast<std::array<unsigned char, sizeof(T)>>(value);
  State state = 0;
  std::memcpy(&state, bytes.data(), bytes.size());
  return state;
}

/// Its inverse, which looks at no further byte.
template <class T>
T value_of(State state) {
  std::array<unsigned char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &state, bytes.size());
  return std::bit_cast<T>(bytes);
}

/// A rule with a small memory as a finite machine: the memory, byte by byte, is the state.
template <Rule R>
class RuleMachine final : public Machine {
public:
  State start() const override { return bytes_of(R{}); }

  double cooperation(State state) const override {
    const R rule = value_of<R>(state);
    if constexpr (MixingRule<R>) {
      return rule.cooperation();
    } else {
      return rule.move() == Move::C ? 1 : 0;
    }
  }

  State next(State state, Move own, Move theirs) const override {
    R rule = value_of<R>(state);
    rule.observe(own, theirs);
    return bytes_of(rule);
  }

  bool deterministic() const override { return !MixingRule<R>; }
};

/// Any rule as a player, which draws the moves of one that mixes. A rule that needs the payoffs, or random numbers of
/// its own, has a member start(const MatchStart&).
template <Rule R>
class RulePlayer final : public Player {
public:
  void start(const MatchStart& match) override {
    rule_ = R{};
    if constexpr (MixingRule<R>) random_numbers_ = RandomStream(match.random);
    if constexpr (requires { rule_.start(match); }) rule_.start(match);
  }
  Move move() override {
    if constexpr (MixingRule<R>) {
      return random_numbers_.chance(rule_.cooperation()) ? Move::C : Move::D;
    } else {
      return rule_.move();
    }
  }
  void observe(Move own, Move theirs) override { rule_.observe(own, theirs); }
  std::unique_ptr<Player> clone() const override { return std::make_unique<RulePlayer>(*this); }

private:
  R rule_;
  RandomStream random_numbers_;
};

template <Rule R>
Strategy machine_by_rule(std::string name) {
  return {std::move(name), std::make_shared<RuleMachine<R>>(), nullptr};
}

template <Rule R>
Strategy played_by_rule(std::string name, bool deterministic = true) {
  Strategy strategy{std::move(name), nullptr, [] { return std::make_unique<RulePlayer<R>>(); }};
  strategy.deterministic = deterministic;
  return strategy;
}

}  // namespace folk
