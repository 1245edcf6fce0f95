#pragma once
// What a transformer thinks in the episodes of a block, step by step: its beliefs, and its actions on them.

#include <folk/mpe/network/mlp.h>
#include <folk/mpe/players/transformer_policy.h>
#include <folk/sct/network/heads.h>
#include <folk/sct/network/stream.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace folk::mpe {

/// A policy made ready to play; shared by all its players.
struct TransformerMind {
  explicit TransformerMind(TransformerPolicy policy);

  TransformerPolicy policy;
  sct::Network<float> network;
  sct::Heads<float> belief;  ///< on the hidden states of the observations
  sct::Heads<float> action;  ///< on these and, where the readout looks at it, on that of the belief token

  bool believes() const { return policy.mode != sct::LossMode::action_only; }

  /// Does what stands in the present belief token reach the action?
  bool acts_on_belief() const { return policy.architecture.readout != sct::Readout::own; }
};

/// What is seen in one step of one episode.
struct Glimpse {
  std::span<const float> observations;    ///< of all predators, as the world gives them  [predators * size]
  float reward = 0;                       ///< of a predator in the step before; 0 in the first
  std::span<const float, 2> prey_action;  ///< in the step before; 0 in the first
  std::span<const float> own_actions;     ///< likewise, as played  [predators * 2]
};

/// Thinks episodes through side by side, with exactly the windows that training drew: the last `context` steps, each
/// with its own row of the time table; keys and values of past tokens are kept for as long as the window's beginning
/// stays where it is. What it thinks of an episode does not depend on those beside it.
///
/// In the past belief slots stands what training put there. `teacher`: the prey's true actions, as in the published
/// program. `selfconf`, `composite`: the beliefs; these come from a stream of their own whose past slots hold the true
/// actions, as in the first pass of training, and stay what they were when they were held (training forms them anew
/// from each window's first step, which differs once the window slides).
class TransformerThinker {
public:
  /// `mind` must outlive this. `target`: the asked return, unscaled.
  TransformerThinker(const TransformerMind& mind, std::size_t episodes, double target);

  /// All episodes anew.
  void restart();

  /// The next step begins; one glimpse an episode. Returns the beliefs [episodes, 2], zero for a policy without.
  const Matrix<float>& see(std::span<const Glimpse> glimpses);

  /// The actions [episodes, predators * 2] on what is put into the present belief tokens [episodes, 2]. May be asked
  /// again with other beliefs; the last ones are remembered.
  const Matrix<float>& act(const Matrix<float>& beliefs);

private:
  /// A stream with where its window begins and how many steps it has seen.
  struct Line {
    sct::Stream stream;
    std::size_t first_step = 0;
    std::size_t seen = 0;
    Matrix<float> hidden;  // of the present observations  [episodes * predators, h]
  };

  /// Steps of the longest window: the context, or where that is longer an episode, whose steps the time table has.
  std::size_t longest_window() const {
    return std::min(mind_.policy.architecture.context, mind_.policy.architecture.time_rows);
  }

  std::size_t now() const { return past_prey_.size(); }
  void advance(Line& line, const std::vector<Matrix<float>>& slots);
  void embed_steps(const std::vector<Matrix<float>>& slots, std::size_t first);

  const TransformerMind& mind_;
  std::size_t episodes_;
  float target_;
  bool begun_ = false;
  // One matrix a step, a row an episode; the last two have an entry for past steps alone.
  std::vector<Matrix<float>> returns_, observations_, beliefs_, past_prey_, past_own_;
  Line belief_line_;
  std::optional<Line> action_line_;  // of selfconf
  sct::EmbeddingTape<float> embedding_;
  Matrix<float> embedded_, tokens_, belief_, actions_, hidden_;
};

}  // namespace folk::mpe
