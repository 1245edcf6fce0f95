#pragma once
// What a trained policy thinks in one round of one match: its belief, and the action it takes on it.

#include <folk/sct/data/windows.h>
#include <folk/sct/network/embedding.h>
#include <folk/sct/network/heads.h>
#include <folk/sct/network/stream.h>
#include <folk/sct/policy/policy.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace folk::sct {

/// A policy made ready to play; shared by all its players.
struct Mind {
  /// Throws UsageError for a policy that cannot play 2x2 games: other observations, more agents, continuous actions.
  explicit Mind(Policy policy);

  Policy policy;
  Network<float> network;
  Heads<float> heads;  ///< on the hidden states of the observation and, where there is one, of the belief token

  /// Rounds that an observation tells of.
  std::size_t remembered() const { return policy.architecture.observation_size / observation_size; }

  /// What a return token holds of a return or reward.
  double return_token(double unscaled) const {
    return policy.training.shows_return ? unscaled / policy.training.return_scale : 0;
  }

  bool believes() const { return policy.training.mode != LossMode::action_only; }
};

/// All that a player remembers of a match; past rounds have an entry in each vector.
struct MatchSoFar {
  std::vector<float> returns;              ///< the return tokens, scaled; one more than past rounds
  std::vector<std::uint8_t> observations;  ///< likewise
  std::vector<std::uint8_t> opponent;      ///< moves
  std::vector<std::uint8_t> own;           ///< moves
  std::vector<std::uint8_t> beliefs;       ///< the moves that were held likelier

  bool operator==(const MatchSoFar&) const = default;
};

/// Before the first round; `target`: the asked return, scaled.
MatchSoFar begin_match(double target);

/// A round was played: what was really moved, which move was held likelier, what it paid (scaled).
void add_round(MatchSoFar& so_far, Move own, Move theirs, Move believed, double reward);

/// Embeds all tokens of all rounds of a batch [rounds * tokens of a round, h]; `tape` is room for it.
void embed_tokens(const Mind& mind, const Batch<float>& batch, EmbeddingTape<float>& tape, Matrix<float>& embedded);

/// P(the first of two classes) by their logits in a row.
double first_class(const Matrix<float>& logits, Index row = 0);

struct Thought {
  double belief = 0.5;       ///< P(the opponent plays C)
  double cooperation = 0.5;  ///< P(own C) by the action head
};

/// Thinks one match through, round by round, with exactly the windows that training drew: the last `context` rounds,
/// each with its own row of the time table.
///
/// In the past belief slots stands what training put there. `teacher`: the true moves. `selfconf`: the beliefs; these
/// come from a stream of their own whose past slots hold the true moves, as in the first pass of training, and stay
/// what they were when they were held (training forms them anew from each window's first round).
class Thinker {
public:
  /// `mind` must outlive this.
  explicit Thinker(const Mind& mind);

  /// The round after so_far.own.size() past ones. `forced_belief`: this move stands in the belief slot whatever the
  /// belief is.
  Thought think(const MatchSoFar& so_far, std::optional<Move> forced_belief = std::nullopt);

  /// The belief alone.
  double believe(const MatchSoFar& so_far);

  /// The tokens that the last belief was read off, up to and with the present observation: the first `tokens` of the
  /// stream, which the next thought changes.
  struct Present {
    const Stream& stream;
    std::size_t tokens;
  };
  Present present() const { return {belief_line_.stream, present_tokens_}; }

private:
  /// A stream with what its belief slots hold, and how many of its tokens are as they must be.
  struct Line {
    Stream stream;
    std::size_t first_round = 0;
    std::size_t settled = 0;  // past rounds whose tokens are all in the stream
  };

  Matrix<float> advance(Line& line, const MatchSoFar& so_far, const std::vector<std::uint8_t>& slots);
  Matrix<float> hidden_at_observation(const MatchSoFar& so_far);
  double belief_of(const Matrix<float>& hidden) const;
  Matrix<float> slot_token(const MatchSoFar& so_far, Move slot);
  void embed_rounds(const MatchSoFar& so_far, const std::vector<std::uint8_t>& slots, std::size_t first);

  const Mind& mind_;
  Line belief_line_;
  std::optional<Line> action_line_;  // of selfconf
  std::size_t present_tokens_ = 0;   // of the belief line
  EmbeddingTape<float> embedding_;
  Matrix<float> embedded_;
};

}  // namespace folk::sct
