#include <folk/games/error.h>
#include <folk/mpe/online/learner.h>
#include <folk/mpe/world/random_stream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace folk::mpe {
namespace {

/// A batch is dealt to so many pieces, whatever the number of threads: their sums are added in order.
constexpr std::size_t batch_pieces = 4;

constexpr sct::AdamWSettings adam(double rate, double clip) {
  sct::AdamWSettings settings;
  settings.learning_rate = rate;
  settings.weight_decay = 0;
  settings.clip = clip;
  settings.warmup_steps = 0;
  return settings;
}

LearningNetwork fresh(const MlpShape& shape, std::uint64_t seed, std::uint64_t number) {
  LearningNetwork network;
  network.parameters = initial_parameters(shape, seed, number);
  network.target = network.parameters;
  network.optimiser.first.resize(shape.parameters());
  network.optimiser.second.resize(shape.parameters());
  return network;
}

}  // namespace

struct Learner::Piece {
  std::size_t rows = 0;
  Matrix<float> now;                   // [observations | actions | rewards] of each example
  Matrix<float> next;                  // the same of the moment after
  std::vector<Matrix<float>> actions;  // of the targets' actors, one an agent that learns
  MlpTape<float> actor;
  std::array<MlpTape<float>, 2> critic;
  Matrix<float> now_input;  // of the critics
  Matrix<float> next_input;
  Matrix<float> actor_input;  // of a critic that judges an actor
  Matrix<float> wanted;       // what the critics should say
  Matrix<float> squashed;
  Matrix<float> gradient;  // with respect to an output
  Matrix<float> input_gradient;
  std::vector<std::array<std::vector<float>, 2>> critic_gradients;  // [agent][critic]
  std::vector<std::vector<float>> actor_gradients;                  // [agent]
  std::vector<double> critic_losses;                                // [agent], sums over the rows
  std::vector<double> values;
};

Learner::Learner(const Layout& layout, const OnlineSettings& settings)
    : layout_(layout),
      settings_(settings),
      workers_(std::min<unsigned>(settings.threads, batch_pieces)) {
  require_sound(settings);
  const std::size_t learning = layout.agents() - (settings.prey_learns ? 0 : 1);
  const std::size_t h = settings.hidden;
  for (std::size_t agent = 0; agent < learning; ++agent) {
    const std::size_t own = layout.scenario().observation_size(agent);
    actor_shapes_.emplace_back(std::vector{own, h, h, std::size_t{2}});
    const bool all = settings.critic == Critic::centralised;
    const std::size_t inputs = all ? layout.observation_rows() + layout.action_rows() : own + 2;
    critic_shapes_.emplace_back(std::vector{inputs, h, h, std::size_t{1}});
    LearningAgent state;
    state.actor = fresh(actor_shapes_.back(), settings.seed, agent);
    for (std::size_t k = 0; k < settings.critics(); ++k)
      state.critics.push_back(fresh(critic_shapes_.back(), settings.seed, 100 + 10 * agent + k));
    state_.push_back(std::move(state));
  }
  for (std::size_t p = 0; p < batch_pieces; ++p) {
    auto& piece = *pieces_.emplace_back(std::make_unique<Piece>());
    piece.rows = (p + 1) * settings.batch / batch_pieces - p * settings.batch / batch_pieces;
    piece.actions.resize(learning);
    piece.critic_gradients.resize(learning);
    piece.actor_gradients.resize(learning);
    piece.critic_losses.resize(learning);
    piece.values.resize(learning);
  }
}

Learner::~Learner() = default;

PolicyNetwork Learner::policy(std::size_t agent) const {
  return {actor_shapes_[agent], state_[agent].actor.parameters, std::nullopt, Squash::tanh};
}

void Learner::gather(const ReplayMemory& memory, std::size_t p) {
  Piece& piece = *pieces_[p];
  const Index width = index(memory.observations() + memory.actions() + 2);
  piece.now.resize(index(piece.rows), width);
  piece.next.resize(index(piece.rows), width);
  RandomStream random = random_stream(settings_.seed, RandomUse::replay, updates_, p);
  for (Index r = 0; r < piece.now.rows(); ++r) {
    const auto transition = memory.transition(static_cast<std::size_t>(random() % memory.transitions()));
    std::copy_n(transition.now, width, piece.now.row(r).data());
    std::copy_n(transition.next, width, piece.next.row(r).data());
  }
}

void Learner::choose_target_actions(Piece& piece, std::size_t number) {
  for (std::size_t agent = 0; agent < agents(); ++agent) {
    piece.actor.prepare(actor_shapes_[agent], piece.rows);
    piece.actor.input() = piece.next.middleCols(index(layout_.observation_begin(agent)), piece.actor.input().cols());
    forward(actor_shapes_[agent], state_[agent].actor.target.data(), piece.actor);
    auto& actions = piece.actions[agent];
    squash(Squash::tanh, piece.actor.output(), actions);
    if (settings_.target_noise == 0) continue;
    RandomStream random = random_stream(settings_.seed, RandomUse::target_noise, updates_, number, agent);
    const double most = settings_.target_noise_clip;
    for (Index i = 0; i < actions.size(); ++i) {
      const double noise = std::clamp(settings_.target_noise * random.normal(), -most, most);
      actions.data()[i] = static_cast<float>(std::clamp(static_cast<double>(actions.data()[i]) + noise, -1.0, 1.0));
    }
  }
}

/// What a critic sees: at the moment itself, or at the next with the targets' actions. Centralised critics all see the
/// same.
const Matrix<float>& Learner::critic_input(Piece& piece, std::size_t agent, bool next) const {
  const Matrix<float>& rows = next ? piece.next : piece.now;
  Matrix<float>& input = next ? piece.next_input : piece.now_input;
  const Index all = index(layout_.observation_rows());
  input.resize(rows.rows(), index(critic_shapes_[agent].inputs()));
  if (settings_.critic == Critic::centralised) {
    if (agent > 0) return input;
    input = rows.leftCols(input.cols());
    for (std::size_t k = 0; next && k < agents(); ++k) input.middleCols(all + 2 * index(k), 2) = piece.actions[k];
  } else {
    const Index own = input.cols() - 2;
    input.leftCols(own) = rows.middleCols(index(layout_.observation_begin(agent)), own);
    if (next)
      input.rightCols(2) = piece.actions[agent];
    else
      input.rightCols(2) = rows.middleCols(all + 2 * index(agent), 2);
  }
  return input;
}

/// Of the mean over the batch of (Q(o, a) - r - discount min Q'(o', pi'(o')))^2.
void Learner::critic_gradient(Piece& piece, std::size_t agent) {
  const MlpShape& shape = critic_shapes_[agent];
  auto& critics = state_[agent].critics;
  const Index rows = index(piece.rows);
  const Matrix<float>& next = critic_input(piece, agent, true);
  for (std::size_t k = 0; k < critics.size(); ++k) {
    piece.critic[k].prepare(shape, next);
    forward(shape, critics[k].target.data(), piece.critic[k]);
  }
  const bool prey = agent == layout_.scenario().prey();
  const Index reward = index(layout_.observation_rows() + layout_.action_rows() + (prey ? 1 : 0));
  const float discount = static_cast<float>(settings_.discount);
  Matrix<float>& wanted = piece.wanted;
  wanted.resize(rows, 1);
  for (Index r = 0; r < rows; ++r) {
    float value = piece.critic[0].output()(r, 0);
    if (critics.size() > 1) value = std::min(value, piece.critic[1].output()(r, 0));
    wanted(r, 0) = piece.now(r, reward) + discount * value;
  }
  piece.critic_losses[agent] = 0;
  const float scale = 2.0F / static_cast<float>(settings_.batch);
  const Matrix<float>& now = critic_input(piece, agent, false);
  for (std::size_t k = 0; k < critics.size(); ++k) {
    piece.critic[k].prepare(shape, now);
    forward(shape, critics[k].parameters.data(), piece.critic[k]);
    piece.gradient = piece.critic[k].output() - wanted;
    for (Index r = 0; r < rows; ++r) {
      const double error = static_cast<double>(piece.gradient(r, 0));
      piece.critic_losses[agent] += error * error / static_cast<double>(critics.size());
    }
    piece.gradient *= scale;
    auto& gradient = piece.critic_gradients[agent][k];
    gradient.assign(shape.parameters(), 0.0F);
    backward<float>(shape, critics[k].parameters.data(), piece.critic[k], piece.gradient, gradient.data(), nullptr);
  }
}

/// Of the mean over the batch of -Q(o, a with pi(o) in place of the own action) + penalty * |z|^2 / 2 for the action
/// tanh(z).
void Learner::actor_gradient(Piece& piece, std::size_t agent) {
  const MlpShape& shape = actor_shapes_[agent];
  const MlpShape& critic_shape = critic_shapes_[agent];
  auto& state = state_[agent];
  piece.actor.prepare(shape, piece.rows);
  piece.actor.input() = piece.now.middleCols(index(layout_.observation_begin(agent)), piece.actor.input().cols());
  forward(shape, state.actor.parameters.data(), piece.actor);
  squash(Squash::tanh, piece.actor.output(), piece.squashed);

  auto& critic = piece.critic[0];
  Matrix<float>& input = piece.actor_input;
  input = critic_input(piece, agent, false);
  const bool all = settings_.critic == Critic::centralised;
  const Index own = all ? index(layout_.observation_rows()) + 2 * index(agent) : input.cols() - 2;
  input.middleCols(own, 2) = piece.squashed;
  critic.prepare(critic_shape, input);
  forward(critic_shape, state.critics[0].parameters.data(), critic);
  piece.values[agent] = 0;
  for (Index r = 0; r < critic.output().rows(); ++r) piece.values[agent] += static_cast<double>(critic.output()(r, 0));

  const float scale = 1.0F / static_cast<float>(settings_.batch);
  piece.gradient = Matrix<float>::Constant(index(piece.rows), 1, -scale);
  backward<float>(critic_shape, state.critics[0].parameters.data(), critic, piece.gradient, nullptr,
                  &piece.input_gradient, {own, 2});
  const float penalty = static_cast<float>(settings_.action_penalty) * scale;
  piece.gradient.resize(index(piece.rows), 2);
  for (Index r = 0; r < piece.gradient.rows(); ++r)
    for (Index c = 0; c < 2; ++c) {
      const float action = piece.squashed(r, c);
      piece.gradient(r, c) = piece.input_gradient(r, c) * (1 - action * action) + penalty * piece.actor.output()(r, c);
    }
  auto& gradient = piece.actor_gradients[agent];
  gradient.assign(shape.parameters(), 0.0F);
  backward<float>(shape, state.actor.parameters.data(), piece.actor, piece.gradient, gradient.data(), nullptr);
}

/// Adds the pieces' gradients in their order and takes a step. `which`: a critic, or 2 for the actor.
void Learner::descend(LearningNetwork& network, std::size_t agent, std::size_t which, double rate) {
  const auto part = [&](Piece& piece) -> std::vector<float>& {
    return which == 2 ? piece.actor_gradients[agent] : piece.critic_gradients[agent][which];
  };
  std::vector<float>& sum = part(*pieces_[0]);
  for (std::size_t p = 1; p < batch_pieces; ++p) {
    const auto& gradient = part(*pieces_[p]);
    if (gradient.empty()) continue;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += gradient[i];
  }
  const std::pair<std::size_t, std::size_t> everything{0, sum.size()};
  sct::adamw_step<float>(adam(rate, settings_.clip), std::span(&everything, 1), sum, network.optimiser,
                         network.parameters);
}

void Learner::follow(LearningNetwork& network) const {
  const float tau = static_cast<float>(settings_.averaging);
  for (std::size_t i = 0; i < network.target.size(); ++i)
    network.target[i] = network.target[i] * (1 - tau) + network.parameters[i] * tau;
}

OnlineLosses Learner::update(const ReplayMemory& memory, double rate) {
  OnlineLosses losses;
  const double examples = static_cast<double>(settings_.batch * agents());
  workers_.run(batch_pieces, [&](std::size_t p, unsigned) {
    gather(memory, p);
    choose_target_actions(*pieces_[p], p);
    for (std::size_t agent = 0; agent < agents(); ++agent) critic_gradient(*pieces_[p], agent);
  });
  workers_.run(agents() * settings_.critics(), [&](std::size_t i, unsigned) {
    const std::size_t agent = i / settings_.critics();
    const std::size_t which = i % settings_.critics();
    descend(state_[agent].critics[which], agent, which, rate);
  });
  for (const auto& piece : pieces_)
    for (const double loss : piece->critic_losses) losses.critic += loss / examples;
  if (updates_ % settings_.actor_every() == settings_.actor_every() - 1) {
    workers_.run(batch_pieces, [&](std::size_t p, unsigned) {
      for (std::size_t agent = 0; agent < agents(); ++agent) actor_gradient(*pieces_[p], agent);
    });
    workers_.run(agents(), [&](std::size_t agent, unsigned) {
      descend(state_[agent].actor, agent, 2, rate);
      follow(state_[agent].actor);
      for (auto& critic : state_[agent].critics) follow(critic);
    });
    losses.value = 0;
    for (const auto& piece : pieces_)
      for (const double value : piece->values) *losses.value += value / examples;
  }
  ++updates_;
  return losses;
}

void Learner::restore(std::vector<LearningAgent> state, std::uint64_t updates) {
  const auto fits = [](const LearningNetwork& there, const LearningNetwork& here) {
    return there.parameters.size() == here.parameters.size() && there.target.size() == here.target.size() &&
           there.optimiser.first.size() == here.optimiser.first.size() &&
           there.optimiser.second.size() == here.optimiser.second.size();
  };
  bool same = state.size() == state_.size();
  for (std::size_t agent = 0; same && agent < state.size(); ++agent) {
    same = fits(state[agent].actor, state_[agent].actor) && state[agent].critics.size() == state_[agent].critics.size();
    for (std::size_t k = 0; same && k < state[agent].critics.size(); ++k)
      same = fits(state[agent].critics[k], state_[agent].critics[k]);
  }
  if (!same) throw UsageError("a checkpoint of other networks: resume with the settings it was made with");
  state_ = std::move(state);
  updates_ = updates;
}

}  // namespace folk::mpe
