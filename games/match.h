#pragma once
// One match between any two things that can play.

#include <folk/games/move.h>

#include <concepts>
#include <cstdint>

namespace folk {

/// Anything that says its next move and is told what was really played.
template <class T>
concept Plays = requires(T& player, Move move) {
  { player.move() } -> std::convertible_to<Move>;
  player.observe(move, move);
};

/// Never flips a move.
struct NoNoise {
  bool operator()() const { return false; }
};

/// Plays `rounds` rounds and hands each to `sink(first's move, second's move)`.
/// `slips()` is asked once a player and round, the first player first, whether its move flips;
/// both players learn the move really played.
template <Plays A, Plays B, class Slips, class Sink>
void play_match(A& first, B& second, std::uint64_t rounds, Slips&& slips, Sink&& sink) {
  for (std::uint64_t t = 0; t < rounds; ++t) {
    Move a = first.move();
    Move b = second.move();
    if (slips()) a = other(a);
    if (slips()) b = other(b);
    sink(a, b);
    first.observe(a, b);
    second.observe(b, a);
  }
}

}  // namespace folk
