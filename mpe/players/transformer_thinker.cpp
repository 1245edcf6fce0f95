#include <folk/mpe/players/transformer_thinker.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace folk::mpe {
namespace {

std::vector<std::size_t> observation_tokens(const sct::Architecture& architecture) {
  std::vector<std::size_t> tokens(architecture.agents);
  std::iota(tokens.begin(), tokens.end(), architecture.observation_token(0));
  return tokens;
}

std::vector<std::size_t> acting_tokens(const sct::Architecture& architecture) {
  auto tokens = observation_tokens(architecture);
  if (architecture.readout != sct::Readout::own) tokens.push_back(architecture.opponent_token());
  return tokens;
}

void append_row(std::vector<float>& numbers, const Matrix<float>& matrix, std::size_t row) {
  const float* begin = matrix.data() + index(row) * matrix.cols();
  numbers.insert(numbers.end(), begin, begin + matrix.cols());
}

}  // namespace

TransformerMind::TransformerMind(TransformerPolicy trained)
    : policy(std::move(trained)),
      network(policy.architecture),
      belief(policy.architecture, network.layout(), observation_tokens(policy.architecture)),
      action(policy.architecture, network.layout(), acting_tokens(policy.architecture)) {}

TransformerThinker::TransformerThinker(const TransformerMind& mind, std::size_t episodes, double target)
    : mind_(mind),
      episodes_(episodes),
      target_(static_cast<float>(target / mind.policy.return_scale)),
      belief_line_{sct::Stream(mind.network, mind.policy.parameters.data(), episodes, longest_window()), 0, 0, {}} {
  if (mind.policy.mode == sct::LossMode::selfconf || mind.policy.mode == sct::LossMode::composite)
    action_line_.emplace(
        Line{sct::Stream(mind.network, mind.policy.parameters.data(), episodes, longest_window()), 0, 0, {}});
}

void TransformerThinker::restart() {
  for (auto* past : {&returns_, &observations_, &beliefs_, &past_prey_, &past_own_}) past->clear();
  begun_ = false;
  belief_line_.seen = belief_line_.first_step = 0;
  if (action_line_) action_line_->seen = action_line_->first_step = 0;
}

/// Embeds all tokens of the steps from `first` to the present one; what is not known of the latter yet reads 0.
void TransformerThinker::embed_steps(const std::vector<Matrix<float>>& slots, std::size_t first) {
  const auto& architecture = mind_.policy.architecture;
  sct::Batch<float> batch;
  batch.window_rounds.assign(episodes_, now() + 1 - first);
  for (std::size_t e = 0; e < episodes_; ++e)
    for (std::size_t t = first; t <= now(); ++t) {
      batch.returns.push_back(returns_[t](index(e), 0));
      append_row(batch.observations, observations_[t], e);
      batch.timesteps.push_back(architecture.time_row(t));
      if (t < slots.size())
        append_row(batch.opponent.numbers, slots[t], e);
      else
        batch.opponent.numbers.insert(batch.opponent.numbers.end(), architecture.action_size, 0.0F);
      if (t < now())
        append_row(batch.own.numbers, past_own_[t], e);
      else
        batch.own.numbers.insert(batch.own.numbers.end(), architecture.agents * architecture.action_size, 0.0F);
    }
  std::vector<std::size_t> every(architecture.round_tokens());
  std::iota(every.begin(), every.end(), std::size_t{0});
  const sct::Chunk<float> chunk{batch, 0, 0, batch.window_rounds};
  const sct::TokenRows rows(batch.window_rounds, every.size(), every);
  sct::embed(architecture, mind_.network.embedding(), mind_.policy.parameters.data(), chunk, batch.opponent, rows,
             sct::Dropout(), embedding_, embedded_);
}

/// The stream up to and with the present observations. Of the step before, the observations are in it already, unless
/// the window's beginning has moved.
void TransformerThinker::advance(Line& line, const std::vector<Matrix<float>>& slots) {
  const auto& architecture = mind_.policy.architecture;
  const std::size_t step_tokens = architecture.round_tokens();
  const std::size_t ready = architecture.observation_token(0) + architecture.agents;
  const std::size_t first = now() + 1 - std::min(now() + 1, longest_window());
  const bool follows = now() > first && line.first_step == first && line.seen == now();
  const std::size_t from = follows ? now() - 1 : first;
  const std::size_t there = follows ? ready : 0;  // tokens of step `from` that are in the stream
  line.first_step = first;
  line.seen = now() + 1;
  line.stream.keep((from - first) * step_tokens + there);
  embed_steps(slots, from);
  const std::size_t all = (now() - from + 1) * step_tokens;
  const std::size_t added = all - step_tokens + ready - there;
  tokens_.resize(index(episodes_ * added), embedded_.cols());
  for (std::size_t e = 0; e < episodes_; ++e)
    tokens_.middleRows(index(e * added), index(added)) = embedded_.middleRows(index(e * all + there), index(added));
  line.hidden = line.stream.append(tokens_, architecture.agents);
}

const Matrix<float>& TransformerThinker::see(std::span<const Glimpse> glimpses) {
  const auto& architecture = mind_.policy.architecture;
  const Index actions = index(architecture.agents * architecture.action_size);
  const Index size = index(architecture.observation_size);
  Matrix<float> returns(index(episodes_), 1), observations(index(episodes_), index(architecture.agents) * size);
  Matrix<float> prey(index(episodes_), 2), own(index(episodes_), actions);
  for (std::size_t e = 0; e < episodes_; ++e) {
    const Glimpse& glimpse = glimpses[e];
    const Index row = index(e);
    std::copy(glimpse.observations.begin(), glimpse.observations.end(), observations.row(row).data());
    for (std::size_t i = 0; i < architecture.agents; ++i)
      mind_.policy.scale.apply(i, {observations.row(row).data() + index(i) * size, architecture.observation_size});
    std::copy(glimpse.prey_action.begin(), glimpse.prey_action.end(), prey.row(row).data());
    std::copy(glimpse.own_actions.begin(), glimpse.own_actions.end(), own.row(row).data());
    returns(row, 0) =
        begun_ ? returns_.back()(row, 0) - glimpse.reward / static_cast<float>(mind_.policy.return_scale) : target_;
  }
  if (begun_) {
    past_prey_.push_back(std::move(prey));
    past_own_.push_back(std::move(own));
  }
  begun_ = true;
  returns_.push_back(std::move(returns));
  observations_.push_back(std::move(observations));
  advance(belief_line_, past_prey_);
  if (mind_.believes())
    mind_.belief.belief(mind_.policy.parameters.data(), belief_line_.hidden, belief_);
  else
    belief_.setZero(index(episodes_), 2);
  if (action_line_) advance(*action_line_, beliefs_);
  return belief_;
}

const Matrix<float>& TransformerThinker::act(const Matrix<float>& beliefs) {
  const auto& architecture = mind_.policy.architecture;
  Line& line = action_line_ ? *action_line_ : belief_line_;
  beliefs_.resize(now());
  beliefs_.push_back(beliefs);
  if (!mind_.acts_on_belief()) {
    mind_.action.action(mind_.policy.parameters.data(), line.hidden, actions_);
    return actions_;
  }
  const std::size_t observations_end =
      (now() - line.first_step) * architecture.round_tokens() + architecture.opponent_token();
  line.stream.keep(observations_end);
  embed_steps(beliefs_, now());
  const Index step_tokens = index(architecture.round_tokens());
  tokens_.resize(index(episodes_), embedded_.cols());
  for (Index e = 0; e < index(episodes_); ++e)
    tokens_.row(e) = embedded_.row(e * step_tokens + index(architecture.opponent_token()));
  const Matrix<float>& opponent = line.stream.append(tokens_);
  const Index agents = index(architecture.agents);
  hidden_.resize(index(episodes_) * (agents + 1), opponent.cols());
  for (Index e = 0; e < index(episodes_); ++e) {
    hidden_.middleRows(e * (agents + 1), agents) = line.hidden.middleRows(e * agents, agents);
    hidden_.row(e * (agents + 1) + agents) = opponent.row(e);
  }
  mind_.action.action(mind_.policy.parameters.data(), hidden_, actions_);
  return actions_;
}

}  // namespace folk::mpe
