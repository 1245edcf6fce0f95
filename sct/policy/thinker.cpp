#include <folk/games/error.h>
#include <folk/sct/policy/thinker.h>
#include <folk/strategies/player.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk::sct {
namespace {

std::vector<std::size_t> play_tokens(const Architecture& architecture) {
  std::vector<std::size_t> tokens{architecture.observation_token(0)};
  if (architecture.belief_token) tokens.push_back(architecture.opponent_token());
  return tokens;
}

Policy playable(Policy policy) {
  const auto& architecture = policy.architecture;
  if (architecture.agents != 1 || !architecture.discrete || architecture.action_size != 2 ||
      architecture.observation_size % observation_size != 0 ||
      architecture.observation_size / observation_size > most_remembered)
    throw UsageError(fmt::format(
        "the policy has {} agents, {} actions of size {} and observations of size {}: a player of 2x2 games has one "
        "agent, two actions and observations of size {} for each of at most {} rounds",
        architecture.agents, architecture.discrete ? "discrete" : "continuous", architecture.action_size,
        architecture.observation_size, observation_size, most_remembered));
  return policy;
}

}  // namespace

double first_class(const Matrix<float>& logits, Index row) {
  return 1 / (1 + std::exp(static_cast<double>(logits(row, 1)) - static_cast<double>(logits(row, 0))));
}

MatchSoFar begin_match(double target) {
  MatchSoFar so_far;
  so_far.returns.push_back(static_cast<float>(target));
  so_far.observations.push_back(start_observation);
  return so_far;
}

void add_round(MatchSoFar& so_far, Move own, Move theirs, Move believed, double reward) {
  so_far.opponent.push_back(static_cast<std::uint8_t>(bit(theirs)));
  so_far.own.push_back(static_cast<std::uint8_t>(bit(own)));
  so_far.beliefs.push_back(static_cast<std::uint8_t>(bit(believed)));
  so_far.observations.push_back(observation_of(own, theirs));
  so_far.returns.push_back(so_far.returns.back() - static_cast<float>(reward));
}

Mind::Mind(Policy trained)
    : policy(playable(std::move(trained))),
      network(policy.architecture),
      heads(policy.architecture, network.layout(), play_tokens(policy.architecture)) {}

void embed_tokens(const Mind& mind, const Batch<float>& batch, EmbeddingTape<float>& tape, Matrix<float>& embedded) {
  const auto& architecture = mind.policy.architecture;
  std::vector<std::size_t> every(architecture.round_tokens());
  for (std::size_t i = 0; i < every.size(); ++i) every[i] = i;
  const TokenRows rows(batch.window_rounds, every.size(), every);
  embed(architecture, mind.network.embedding(), mind.policy.parameters.data(),
        Chunk<float>{batch, 0, 0, batch.window_rounds}, batch.opponent, rows, Dropout(), tape, embedded);
}

Thinker::Thinker(const Mind& mind)
    : mind_(mind),
      belief_line_{Stream(mind.network, mind.policy.parameters.data())} {
  if (mind.policy.training.mode == LossMode::selfconf)
    action_line_.emplace(Line{Stream(mind.network, mind.policy.parameters.data())});
}

/// Embeds all tokens of the rounds from `first` to the present one; what is not known of the latter yet reads 0.
void Thinker::embed_rounds(const MatchSoFar& so_far, const std::vector<std::uint8_t>& slots, std::size_t first) {
  const std::size_t now = so_far.own.size();
  const auto& architecture = mind_.policy.architecture;
  Batch<float> batch;
  for (std::size_t t = first; t <= now; ++t) {
    batch.returns.push_back(so_far.returns[t]);
    append_observations(so_far.observations, t, mind_.remembered(), batch.observations);
    batch.timesteps.push_back(architecture.time_row(t));
    batch.opponent.classes.push_back(t < slots.size() ? slots[t] : 0);
    batch.own.classes.push_back(t < now ? so_far.own[t] : 0);
  }
  batch.window_rounds = {now + 1 - first};
  embed_tokens(mind_, batch, embedding_, embedded_);
}

/// The stream up to and with the present observation; returns the latter's hidden state.
Matrix<float> Thinker::advance(Line& line, const MatchSoFar& so_far, const std::vector<std::uint8_t>& slots) {
  const auto& architecture = mind_.policy.architecture;
  const std::size_t now = so_far.own.size();
  const std::size_t first = now + 1 > architecture.context ? now + 1 - architecture.context : 0;
  if (first != line.first_round || line.settled > now) line.settled = first;
  if (line.settled < first) line.settled = first;
  line.first_round = first;
  line.stream.keep((line.settled - first) * architecture.round_tokens());
  embed_rounds(so_far, slots, line.settled);
  const Index past = index((now - line.settled) * architecture.round_tokens());
  const Index ready = past + index(architecture.observation_token(0)) + 1;
  line.settled = now;
  return line.stream.append(embedded_.topRows(ready));
}

/// The present belief token, embedded.
Matrix<float> Thinker::slot_token(const MatchSoFar& so_far, Move slot) {
  const std::size_t now = so_far.own.size();
  const std::vector<std::uint8_t> slots(now + 1, static_cast<std::uint8_t>(bit(slot)));
  embed_rounds(so_far, slots, now);
  return embedded_.row(index(mind_.policy.architecture.opponent_token()));
}

/// The hidden states that the heads read, of which the observation's is known.
Matrix<float> Thinker::hidden_at_observation(const MatchSoFar& so_far) {
  Matrix<float> hidden(index(mind_.heads.read().size()), index(mind_.policy.architecture.hidden));
  hidden.row(0) = advance(belief_line_, so_far, so_far.opponent);
  present_tokens_ = belief_line_.stream.tokens();
  return hidden;
}

double Thinker::belief_of(const Matrix<float>& hidden) const {
  Matrix<float> logits;
  mind_.heads.belief(mind_.policy.parameters.data(), hidden, logits);
  return first_class(logits);
}

double Thinker::believe(const MatchSoFar& so_far) { return belief_of(hidden_at_observation(so_far)); }

Thought Thinker::think(const MatchSoFar& so_far, std::optional<Move> forced_belief) {
  const auto& architecture = mind_.policy.architecture;
  const float* parameters = mind_.policy.parameters.data();
  Thought thought;
  Matrix<float> hidden = hidden_at_observation(so_far);
  Matrix<float> logits;
  if (mind_.believes()) thought.belief = belief_of(hidden);
  const Move slot = forced_belief.value_or(likelier_move(thought.belief));
  auto& acting = action_line_ ? *action_line_ : belief_line_;
  if (action_line_) hidden.row(0) = advance(*action_line_, so_far, so_far.beliefs);
  if (architecture.belief_token) hidden.row(1) = acting.stream.append(slot_token(so_far, slot));
  mind_.heads.action(parameters, hidden, logits);
  thought.cooperation = first_class(logits);
  return thought;
}

}  // namespace folk::sct
