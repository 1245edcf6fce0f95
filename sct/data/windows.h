#pragma once
// Training windows: stretches of matches, drawn so that the rounds that decide are seen often enough.

#include <folk/games/outcome.h>
#include <folk/games/random.h>
#include <folk/sct/data/trajectory.h>
#include <folk/sct/network/batch.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace folk::sct {

/// What a player sees before a round: nothing yet, or the last outcome (own move first).
inline constexpr std::size_t observation_size = 5;
constexpr std::uint8_t start_observation = 0;
inline constexpr std::size_t most_remembered = 16;  ///< rounds that one observation tells of
constexpr std::uint8_t observation_of(Move own, Move theirs) {
  return static_cast<std::uint8_t>(1 + Outcome{own, theirs}.index());
}

/// One match as the network sees it; every vector has one entry a round.
struct Lesson {
  std::vector<std::uint8_t> observations;  ///< 0: start, 1 + outcome
  std::vector<std::uint8_t> opponent;      ///< moves
  std::vector<std::uint8_t> own;           ///< moves as played
  std::vector<std::uint8_t> wanted;        ///< moves that the policy should learn
  std::vector<float> weights;              ///< of the rounds in the policy loss
  std::vector<float> returns;              ///< the return tokens, unscaled
  std::vector<float> beliefs{};            ///< P(the opponent plays C) that the belief should learn; empty: the moves

  std::size_t rounds() const { return own.size(); }
};

/// Appends the last `remembered` observations up to `present`, the newest first, as one number of observation_size each
/// that is 1 and others that are 0; before the first round stands start_observation.
void append_observations(std::span<const std::uint8_t> observations, std::size_t present, std::size_t remembered,
                         std::vector<float>& numbers);

/// Imitation: the moves that were played are wanted, and the return token holds what the player went on to earn.
Lesson imitation(const Trajectory& trajectory);

/// How windows are drawn.
struct WindowSettings {
  std::size_t windows = 64;
  std::size_t context = 20;
  double early = 0.4;                 ///< share of the windows that begin in round 1; the rest begin anywhere
  bool shows_return = true;           ///< else all return tokens hold 0
  double return_scale = 100;          ///< returns are divided by it
  std::size_t remembered = 1;         ///< rounds that an observation tells of
  std::size_t time_rows = 1'000'000;  ///< rounds from this one on have the time row of this one
  double return_jitter = 0;           ///< standard deviation of a number added to all returns of a window, unscaled
};

/// Windows of lessons drawn with equal probability; those shorter than the context are taken whole.
Batch<float> draw_windows(const std::vector<Lesson>& lessons, const WindowSettings& settings, RandomStream& random);

}  // namespace folk::sct
