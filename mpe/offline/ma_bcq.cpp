#include <folk/games/error.h>
#include <folk/mpe/network/setting_ranges.h>
#include <folk/mpe/offline/ma_bcq.h>
#include <folk/mpe/world/random_stream.h>
#include <folk/sct/training/adamw.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace folk::mpe {
namespace {

/// A predator's batch is dealt to so many pieces in learning its actions, whatever the number of threads: their sums
/// are added in order.
constexpr std::size_t vae_pieces = 2;

/// Rows whose candidates are decoded together: few enough to stay in the cache.
constexpr std::size_t rows_together = 256;

LearningNetwork fresh(std::vector<float> parameters, bool target) {
  LearningNetwork network;
  network.parameters = std::move(parameters);
  if (target) network.target = network.parameters;
  network.optimiser.first.resize(network.parameters.size());
  network.optimiser.second.resize(network.parameters.size());
  return network;
}

/// Initial parameters of an autoencoder: those of its two networks.
std::vector<float> initial_parameters(const ActionVaeShape& shape, std::uint64_t seed, std::uint64_t number) {
  auto parameters = initial_parameters(shape.encoder(), seed, number);
  const auto decoder = initial_parameters(shape.decoder(), seed, number + 1);
  parameters.insert(parameters.end(), decoder.begin(), decoder.end());
  return parameters;
}

void put_network(sct::RecordWriter& writer, const LearningNetwork& network) {
  writer.floats(network.parameters);
  writer.floats(network.target);
  writer.word(network.optimiser.steps);
  writer.floats(network.optimiser.first);
  writer.floats(network.optimiser.second);
}

/// Reads a network of the sizes of `here`.
LearningNetwork read_network(sct::RecordReader& reader, const LearningNetwork& here) {
  const auto floats = [&](std::size_t size) {
    auto numbers = reader.floats();
    if (numbers.size() != size)
      reader.refuse("a checkpoint of other networks: resume with the settings it was made with");
    return numbers;
  };
  LearningNetwork network;
  network.parameters = floats(here.parameters.size());
  network.target = floats(here.target.size());
  network.optimiser.steps = reader.steps();
  network.optimiser.first = floats(here.parameters.size());
  network.optimiser.second = floats(here.parameters.size());
  for (const float moment : network.optimiser.second)
    if (moment < 0) reader.wrong("a mean square below 0");
  return network;
}

}  // namespace

void require_sound(const MaBcqSettings& settings) {
  require_count("vae-hidden", settings.vae_hidden, 1, 4096);
  for (const std::size_t units : settings.hidden) require_count("hidden", units, 1, 4096);
  require_number("learning-rate", settings.learning_rate, 1e-9, 1);
  require_number("discount", settings.discount, 0, 0.99999);
  require_number("averaging", settings.averaging, 1e-9, 1);
  require_count("batch", settings.batch, 1, 1 << 20);
  require_count("candidates", settings.candidates, 1, 10'000);
  require_count("acting-candidates", settings.acting_candidates, 1, 10'000);
  require_number("perturbation", settings.perturbation, 0, 2);
  require_number("lambda", settings.lambda, 0, 1);
}

// ---- losses ------------------------------------------------------------------------------------------------------

template <class S>
void mixed_value(const MixedCritics<S>& networks, const std::vector<Matrix<S>>& inputs, MixedCriticsTape<S>& tape,
                 Workers& workers) {
  const Index rows = inputs.front().rows();
  tape.critics.resize(networks.critics.size());
  tape.values.resize(rows, index(networks.critics.size()));
  workers.run(networks.critics.size(), [&](std::size_t i, unsigned) {
    auto& critic = tape.critics[i];
    critic.prepare(networks.critic, inputs[i / 2]);
    forward(networks.critic, networks.critics[i], critic);
    tape.values.col(index(i)) = critic.output();
  });
  mixing_weights(networks.mixer, networks.mixing, tape.mixer);
  mix(tape.mixer, tape.values, tape.mixed);
}

template <class S>
double mixed_critics_loss(const MixedCritics<S>& networks, const std::vector<Matrix<S>>& inputs,
                          const Matrix<S>& wanted, MixedCriticsTape<S>& tape, Workers& workers) {
  mixed_value(networks, inputs, tape, workers);
  const S scale = S(1) / static_cast<S>(wanted.rows());
  tape.mixed_gradient = 2 * scale * (tape.mixed - wanted);
  double errors = 0;
  for (Index r = 0; r < wanted.rows(); ++r) {
    const double error = static_cast<double>(tape.mixed(r, 0)) - static_cast<double>(wanted(r, 0));
    errors += error * error;
  }
  tape.value_gradients.resize(networks.critics.size());
  tape.critic_gradients.resize(networks.critics.size());
  workers.run(networks.critics.size(), [&](std::size_t i, unsigned) {
    auto& gradient = tape.critic_gradients[i];
    gradient.assign(networks.critic.parameters(), S(0));
    tape.value_gradients[i] = tape.mixed_gradient.array() * tape.mixer.weights.col(index(i)).array();
    backward<S>(networks.critic, networks.critics[i], tape.critics[i], tape.value_gradients[i], gradient.data(),
                nullptr);
  });
  tape.mixing_gradient.assign(networks.mixer.parameters(), S(0));
  mixer_backward(networks.mixer, networks.mixing, tape.mixer, tape.values, tape.mixed, tape.mixed_gradient,
                 tape.mixing_gradient.data());
  return errors / static_cast<double>(wanted.rows());
}

template <class S>
double perturbation_loss(NetworkView<S> perturbation, S most, const MlpShape& critic,
                         const std::array<const S*, 2>& critics, const Matrix<S>& weights, PerturbationTape<S>& tape,
                         S* gradient) {
  const auto& candidates = tape.candidates;
  const Index rows = candidates.judged.rows();
  const Index observed = candidates.judged.cols() - 2;
  const S scale = S(1) / static_cast<S>(rows);
  double sum = 0;
  tape.output_gradient.setZero(rows, 2);
  for (std::size_t k = 0; k < critics.size(); ++k) {
    tape.critics[k].prepare(critic, candidates.judged);
    forward(critic, critics[k], tape.critics[k]);
    const auto weight = weights.col(index(k));
    for (Index r = 0; r < rows; ++r)
      sum += static_cast<double>(weight(r)) * static_cast<double>(tape.critics[k].output()(r, 0));
    tape.value_gradient = -scale * weight;
    backward<S>(critic, critics[k], tape.critics[k], tape.value_gradient, nullptr, &tape.action_gradient,
                {observed, 2});
    tape.output_gradient += tape.action_gradient;
  }
  for (Index r = 0; r < rows; ++r)
    for (Index c = 0; c < 2; ++c) {
      const S shift = candidates.shifts(r, c);
      const bool cut = std::abs(candidates.squashed(r, c) + most * shift) > S(1);
      tape.output_gradient(r, c) *= cut ? S(0) : most * (1 - shift * shift);
    }
  backward<S>(perturbation.shape, perturbation.parameters, tape.candidates.perturbation, tape.output_gradient, gradient,
              nullptr);
  return -sum / static_cast<double>(rows);
}

template <class S>
void choose_candidates(const std::array<const Matrix<S>*, 2>& values, std::size_t candidates, S lambda, Index first,
                       Index column, Matrix<S>& chosen) {
  const Index each = index(candidates);
  for (Index state = 0; state * each < values[0]->rows(); ++state) {
    S best = 0;
    for (Index i = state * each; i < (state + 1) * each; ++i) {
      const S one = (*values[0])(i, 0);
      const S other = (*values[1])(i, 0);
      const S value = lambda * std::min(one, other) + (1 - lambda) * std::max(one, other);
      if (i > state * each && !(value > best)) continue;
      best = value;
      chosen(first + state, column) = one;
      chosen(first + state, column + 1) = other;
    }
  }
}

template void mixed_value(const MixedCritics<float>&, const std::vector<Matrix<float>>&, MixedCriticsTape<float>&,
                          Workers&);
template void mixed_value(const MixedCritics<double>&, const std::vector<Matrix<double>>&, MixedCriticsTape<double>&,
                          Workers&);
template double mixed_critics_loss(const MixedCritics<float>&, const std::vector<Matrix<float>>&, const Matrix<float>&,
                                   MixedCriticsTape<float>&, Workers&);
template double mixed_critics_loss(const MixedCritics<double>&, const std::vector<Matrix<double>>&,
                                   const Matrix<double>&, MixedCriticsTape<double>&, Workers&);
template double perturbation_loss(NetworkView<float>, float, const MlpShape&, const std::array<const float*, 2>&,
                                  const Matrix<float>&, PerturbationTape<float>&, float*);
template double perturbation_loss(NetworkView<double>, double, const MlpShape&, const std::array<const double*, 2>&,
                                  const Matrix<double>&, PerturbationTape<double>&, double*);
template void choose_candidates(const std::array<const Matrix<float>*, 2>&, std::size_t, float, Index, Index,
                                Matrix<float>&);
template void choose_candidates(const std::array<const Matrix<double>*, 2>&, std::size_t, double, Index, Index,
                                Matrix<double>&);

// ---- learner -----------------------------------------------------------------------------------------------------

/// What is drawn from the data, and what all threads see of it.
struct MaBcqLearner::Batch {
  /// A piece of a predator's rows, of which the autoencoder learns.
  struct Piece {
    ActionVaeTape<float> tape;
    Matrix<float> normals;
    std::vector<float> gradient;
    double loss = 0;
  };

  std::vector<Matrix<float>> now;   // [observation | action] of each predator
  std::vector<Matrix<float>> next;  // observations
  Matrix<float> states;             // observations of all predators
  Matrix<float> next_states;
  std::vector<float> rewards;
  std::vector<Piece> pieces;  // [agent][piece]
  Matrix<float> next_values;  // of the candidates that are chosen [batch, 2 agents]
  MixerTape<float> next_mixer;
  Matrix<float> wanted;
  MixedCriticsTape<float> critics;
  std::vector<double> actor_losses;
};

/// What a thread computes in.
struct MaBcqLearner::Scratch {
  CandidateTape<float> candidates;
  std::array<MlpTape<float>, 2> critics;
  PerturbationTape<float> perturbation;
  Matrix<float> weights;
  std::vector<float> gradient;
};

MaBcqLearner::MaBcqLearner(const DataSet& data, const MaBcqSettings& settings)
    : data_(data),
      settings_((require_sound(settings), settings)),
      vae_shape_(data.scenario().observation_size(0), settings.vae_hidden),
      perturbation_shape_({vae_shape_.observed() + 2, settings.hidden[0], settings.hidden[1], 2}),
      critic_shape_({vae_shape_.observed() + 2, settings.hidden[0], settings.hidden[1], 1}),
      mixer_shape_(vae_shape_.observed() * data.scenario().predators(), 2 * data.scenario().predators()),
      workers_(settings.threads),
      batch_(std::make_unique<Batch>()) {
  const std::size_t agents = data.scenario().predators();
  for (std::size_t agent = 0; agent < agents; ++agent) {
    const std::uint64_t number = 10 * agent;
    BcqAgent state;
    state.vae = fresh(initial_parameters(vae_shape_, settings.seed, number), false);
    state.perturbation = fresh(initial_parameters(perturbation_shape_, settings.seed, number + 2), true);
    for (std::size_t k = 0; k < 2; ++k)
      state.critics[k] = fresh(initial_parameters(critic_shape_, settings.seed, number + 3 + k), true);
    agents_.push_back(std::move(state));
  }
  mixer_ = fresh(initial_parameters(mixer_shape_.layer(), settings.seed, 1000), true);
  const Index rows = index(settings.batch);
  const Index observed = index(vae_shape_.observed());
  batch_->now.assign(agents, Matrix<float>(rows, observed + 2));
  batch_->next.assign(agents, Matrix<float>(rows, observed));
  batch_->states.resize(rows, observed * index(agents));
  batch_->next_states.resize(rows, observed * index(agents));
  batch_->rewards.resize(settings.batch);
  batch_->pieces.resize(agents * vae_pieces);
  batch_->next_values.resize(rows, 2 * index(agents));
  batch_->wanted.resize(rows, 1);
  batch_->actor_losses.resize(agents);
  for (unsigned thread = 0; thread < workers_.threads(); ++thread) scratch_.push_back(std::make_unique<Scratch>());
}

MaBcqLearner::~MaBcqLearner() = default;

std::vector<NamedLoss> MaBcqLearner::step() {
  gather();
  const double vae = learn_actions();
  choose_next();
  const double critic = learn_values();
  const double actor = learn_perturbations();
  ++steps_;
  return {{"vae", vae}, {"critic", critic}, {"actor", actor}};
}

void MaBcqLearner::gather() {
  RandomStream random = random_stream(settings_.seed, RandomUse::offline_batch, steps_);
  const std::size_t observed = vae_shape_.observed();
  for (std::size_t r = 0; r < settings_.batch; ++r) {
    const auto row = static_cast<std::size_t>(random() % data_.transitions());
    batch_->rewards[r] = data_.reward(0, row);
    for (std::size_t agent = 0; agent < agents_.size(); ++agent) {
      float* now = batch_->now[agent].row(index(r)).data();
      float* next = batch_->next[agent].row(index(r)).data();
      data_.observation(agent, row, {now, observed});
      data_.action(agent, row, std::span<float, 2>(now + observed, 2));
      data_.next_observation(agent, row, {next, observed});
      std::copy_n(now, observed, batch_->states.row(index(r)).data() + agent * observed);
      std::copy_n(next, observed, batch_->next_states.row(index(r)).data() + agent * observed);
    }
  }
}

/// Moves the autoencoders.
double MaBcqLearner::learn_actions() {
  workers_.run(batch_->pieces.size(), [&](std::size_t i, unsigned) {
    const std::size_t agent = i / vae_pieces;
    const std::size_t begin = i % vae_pieces * settings_.batch / vae_pieces;
    const std::size_t rows = (i % vae_pieces + 1) * settings_.batch / vae_pieces - begin;
    auto& piece = batch_->pieces[i];
    piece.tape.encoder.prepare(vae_shape_.encoder(), rows);
    piece.tape.encoder.input() = batch_->now[agent].middleRows(index(begin), index(rows));
    piece.normals.resize(index(rows), index(ActionVaeShape::latent));
    for (std::size_t r = 0; r < rows; ++r) {
      RandomStream random = random_stream(settings_.seed, RandomUse::latent, steps_, begin + r, agent);
      for (float& number : piece.normals.row(index(r))) number = static_cast<float>(random.normal());
    }
    piece.gradient.assign(vae_shape_.parameters(), 0.0F);
    piece.loss = action_vae_loss(vae_shape_, agents_[agent].vae.parameters.data(), piece.normals, settings_.batch,
                                 piece.tape, piece.gradient.data());
  });
  workers_.run(agents_.size(), [&](std::size_t agent, unsigned) {
    auto& sum = batch_->pieces[agent * vae_pieces].gradient;
    for (std::size_t p = 1; p < vae_pieces; ++p) {
      const auto& gradient = batch_->pieces[agent * vae_pieces + p].gradient;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += gradient[i];
    }
    descend(agents_[agent].vae, sum);
  });
  double loss = 0;
  for (const auto& piece : batch_->pieces) loss += piece.loss;
  return loss / static_cast<double>(agents_.size());
}

/// Finds what the predators should do next, and what that makes the present worth.
void MaBcqLearner::choose_next() {
  const std::size_t together = std::max<std::size_t>(1, rows_together / settings_.candidates);
  const std::size_t pieces = (settings_.batch + together - 1) / together;
  workers_.run(agents_.size() * pieces, [&](std::size_t i, unsigned worker) {
    const std::size_t first = i % pieces * together;
    choose_next(i / pieces, first, std::min(together, settings_.batch - first), *scratch_[worker]);
  });
  batch_->next_mixer.layer.prepare(mixer_shape_.layer(), batch_->next_states);
  mixing_weights(mixer_shape_, mixer_.target.data(), batch_->next_mixer);
  mix(batch_->next_mixer, batch_->next_values, batch_->wanted);
  const float discount = static_cast<float>(settings_.discount);
  for (std::size_t r = 0; r < settings_.batch; ++r) {
    float& wanted = batch_->wanted(index(r), 0);
    wanted = batch_->rewards[r] + discount * wanted;
  }
}

void MaBcqLearner::choose_next(std::size_t agent, std::size_t first, std::size_t rows, Scratch& scratch) {
  const BcqAgent& own = agents_[agent];
  auto& candidates = scratch.candidates;
  candidates.decoder.prepare(vae_shape_.decoder(), rows * settings_.candidates);
  float* input = candidates.decoder.input().data();
  for (std::size_t r = first; r < first + rows; ++r) {
    const auto observation = batch_->next[agent].row(index(r));
    RandomStream random = random_stream(settings_.seed, RandomUse::candidates, steps_, r, agent);
    for (std::size_t i = 0; i < settings_.candidates; ++i) {
      input = std::copy(observation.begin(), observation.end(), input);
      draw_latent(random, input, ActionVaeShape::latent);
      input += ActionVaeShape::latent;
    }
  }
  propose<float>(decoder(own), {perturbation_shape_, own.perturbation.target.data()},
                 static_cast<float>(settings_.perturbation), candidates);
  for (std::size_t k = 0; k < 2; ++k) {
    scratch.critics[k].prepare(critic_shape_, candidates.judged);
    forward(critic_shape_, own.critics[k].target.data(), scratch.critics[k]);
  }
  choose_candidates<float>({&scratch.critics[0].output(), &scratch.critics[1].output()}, settings_.candidates,
                           static_cast<float>(settings_.lambda), index(first), 2 * index(agent), batch_->next_values);
}

/// Moves critics and mixer.
double MaBcqLearner::learn_values() {
  auto& tape = batch_->critics;
  tape.mixer.layer.prepare(mixer_shape_.layer(), batch_->states);
  MixedCritics<float> networks{critic_shape_, {}, mixer_shape_, mixer_.parameters.data()};
  for (const auto& agent : agents_)
    for (const auto& critic : agent.critics) networks.critics.push_back(critic.parameters.data());
  const double loss = mixed_critics_loss<float>(networks, batch_->now, batch_->wanted, tape, workers_);
  workers_.run(networks.critics.size() + 1, [&](std::size_t i, unsigned) {
    if (i == networks.critics.size())
      descend(mixer_, tape.mixing_gradient);
    else
      descend(agents_[i / 2].critics[i % 2], tape.critic_gradients[i]);
  });
  return loss;
}

/// Moves the perturbations, and the targets after all that has one.
double MaBcqLearner::learn_perturbations() {
  mixing_weights(mixer_shape_, mixer_.parameters.data(), batch_->critics.mixer);
  workers_.run(agents_.size(), [&](std::size_t agent, unsigned worker) {
    batch_->actor_losses[agent] = learn_perturbation(agent, *scratch_[worker]);
    follow(agents_[agent].perturbation);
    for (auto& critic : agents_[agent].critics) follow(critic);
  });
  follow(mixer_);
  double loss = 0;
  for (const double part : batch_->actor_losses) loss += part;
  return loss;
}

double MaBcqLearner::learn_perturbation(std::size_t agent, Scratch& scratch) {
  BcqAgent& own = agents_[agent];
  auto& tape = scratch.perturbation;
  tape.candidates.decoder.prepare(vae_shape_.decoder(), settings_.batch);
  float* input = tape.candidates.decoder.input().data();
  for (std::size_t r = 0; r < settings_.batch; ++r) {
    // Its streams are those of rows after the next states'.
    RandomStream random = random_stream(settings_.seed, RandomUse::candidates, steps_, settings_.batch + r, agent);
    input = std::copy_n(batch_->now[agent].row(index(r)).data(), vae_shape_.observed(), input);
    draw_latent(random, input, ActionVaeShape::latent);
    input += ActionVaeShape::latent;
  }
  const NetworkView<float> perturbation{perturbation_shape_, own.perturbation.parameters.data()};
  const float most = static_cast<float>(settings_.perturbation);
  propose<float>(decoder(own), perturbation, most, tape.candidates);
  scratch.weights = batch_->critics.mixer.weights.middleCols(2 * index(agent), 2);
  scratch.gradient.assign(perturbation_shape_.parameters(), 0.0F);
  const double loss = perturbation_loss<float>(perturbation, most, critic_shape_,
                                               {own.critics[0].parameters.data(), own.critics[1].parameters.data()},
                                               scratch.weights, tape, scratch.gradient.data());
  descend(own.perturbation, scratch.gradient);
  return loss;
}

void MaBcqLearner::descend(LearningNetwork& network, std::span<const float> gradient) const {
  sct::AdamWSettings adam;
  adam.learning_rate = settings_.learning_rate;
  adam.weight_decay = 0;
  adam.clip = std::numeric_limits<double>::infinity();
  adam.warmup_steps = 0;
  const std::pair<std::size_t, std::size_t> everything{0, gradient.size()};
  sct::adamw_step<float>(adam, std::span(&everything, 1), gradient, network.optimiser, network.parameters);
}

void MaBcqLearner::follow(LearningNetwork& network) const {
  const float tau = static_cast<float>(settings_.averaging);
  for (std::size_t i = 0; i < network.target.size(); ++i)
    network.target[i] = network.target[i] * (1 - tau) + network.parameters[i] * tau;
}

NetworkView<float> MaBcqLearner::decoder(const BcqAgent& agent) const {
  return {vae_shape_.decoder(), agent.vae.parameters.data() + vae_shape_.decoder_begin()};
}

void MaBcqLearner::save(sct::RecordWriter& writer) const {
  writer.word(steps_);
  for (const auto& agent : agents_) {
    put_network(writer, agent.vae);
    put_network(writer, agent.perturbation);
    for (const auto& critic : agent.critics) put_network(writer, critic);
  }
  put_network(writer, mixer_);
}

void MaBcqLearner::load(sct::RecordReader& reader) {
  const auto steps = reader.steps();
  std::vector<BcqAgent> agents;
  for (const auto& here : agents_) {
    BcqAgent agent;
    agent.vae = read_network(reader, here.vae);
    agent.perturbation = read_network(reader, here.perturbation);
    for (std::size_t k = 0; k < 2; ++k) agent.critics[k] = read_network(reader, here.critics[k]);
    agents.push_back(std::move(agent));
  }
  mixer_ = read_network(reader, mixer_);
  agents_ = std::move(agents);
  steps_ = steps;
}

std::string MaBcqLearner::description() const {
  const auto& s = settings_;
  return fmt::format(
      "algorithm = ma-bcq\nscenario = {}\nvae-hidden = {}\nhidden = {} {}\nlearning-rate = {}\ndiscount = {}\n"
      "averaging = {}\nbatch = {}\ncandidates = {}\nacting-candidates = {}\nperturbation = {}\nlambda = {}\n"
      "seed = {}\n",
      data_.scenario().name, s.vae_hidden, s.hidden[0], s.hidden[1], s.learning_rate, s.discount, s.averaging, s.batch,
      s.candidates, s.acting_candidates, s.perturbation, s.lambda, s.seed);
}

BcqPolicy MaBcqLearner::bcq_policy(const std::map<std::string, std::string>& notes) const {
  BcqPolicy policy{data_.scenario().name, {}, settings_.acting_candidates, settings_.perturbation, notes};
  for (const auto& agent : agents_) {
    const auto decoder = agent.vae.parameters.begin() + static_cast<std::ptrdiff_t>(vae_shape_.decoder_begin());
    policy.networks.push_back({{vae_shape_.decoder(), {decoder, agent.vae.parameters.end()}},
                               {perturbation_shape_, agent.perturbation.parameters},
                               {critic_shape_, agent.critics[0].parameters}});
  }
  return policy;
}

std::string MaBcqLearner::policy(const std::map<std::string, std::string>& notes) const {
  return bcq_policy_bytes(bcq_policy(notes));
}

}  // namespace folk::mpe
