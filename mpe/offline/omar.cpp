#include <folk/games/error.h>
#include <folk/mpe/network/setting_ranges.h>
#include <folk/mpe/offline/omar.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/world/random_stream.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace folk::mpe {
namespace {

/// The last layer of an actor starts small: its first actions are near 0, where tanh is steep.
constexpr double small_weights = 3e-3;

struct PublishedRow {
  std::string_view scenario;
  std::string_view level;
  double imitation;
  double conservatism;
  std::uint64_t steps;
};

constexpr std::array published_rows = {
    PublishedRow{"simple_tag", "random", 0.9, 0.5, 2001},   PublishedRow{"simple_tag", "medium-replay", 0.9, 0.5, 1001},
    PublishedRow{"simple_tag", "medium", 0.7, 5, 2001},     PublishedRow{"simple_tag", "expert", 0.9, 5, 2001},
    PublishedRow{"simple_world", "random", 1, 0.5, 1001},   PublishedRow{"simple_world", "medium-replay", 0.7, 1, 1001},
    PublishedRow{"simple_world", "medium", 0.1, 0.5, 1001}, PublishedRow{"simple_world", "expert", 0.9, 5, 1001},
};

const PublishedRow& published_row(std::string_view scenario, std::string_view level) {
  Scenario::named(scenario);
  for (const auto& row : published_rows)
    if (row.scenario == scenario && row.level == level) return row;
  throw UsageError(
      fmt::format("level '{}': OMAR was published for random, medium-replay, medium and expert", excerpt(level)));
}

sct::AdamWSettings adam(double rate, double clip) {
  sct::AdamWSettings settings;
  settings.learning_rate = rate;
  settings.weight_decay = 0;
  settings.clip = clip;
  settings.warmup_steps = 0;
  return settings;
}

}  // namespace

OmarSettings OmarSettings::published(std::string_view scenario, std::string_view level, bool cql) {
  const auto& row = published_row(scenario, level);
  OmarSettings settings;
  settings.cql = cql;
  settings.conservatism = row.conservatism;
  settings.imitation = row.imitation;
  return settings;
}

std::uint64_t published_omar_steps(std::string_view scenario, std::string_view level) {
  return published_row(scenario, level).steps;
}

void require_sound(const OmarSettings& settings) {
  require_number("conservatism", settings.conservatism, 0, 1e6);
  require_number("imitation", settings.imitation, 0, 1);
  require_count("hidden", settings.hidden, 1, 4096);
  require_number("learning-rate", settings.learning_rate, 1e-9, 1);
  require_count("batch", settings.batch, 2, 1 << 20);  // the variance of one is none
  require_number("discount", settings.discount, 0, 0.99999);
  require_number("averaging", settings.averaging, 1e-9, 1);
  require_number("clip", settings.clip, 1e-9, 1e9);
}

struct OmarLearner::Work {
  std::vector<std::size_t> rows;
  std::vector<bool> taken;  // of all rows of the data
  Transitions<float> batch;
  Matrix<float> targets;
  Matrix<float> uniform;
  Matrix<float> best;
  OmarScratch<float> scratch;
  std::vector<float> gradient;
  CriticLoss critic_loss;
  double actor_loss = 0;
};

OmarLearner::OmarLearner(const DataSet& data, const OmarSettings& settings)
    : data_(data),
      settings_(settings),
      workers_(std::min<unsigned>(settings.threads, static_cast<unsigned>(data.scenario().predators()))) {
  require_sound(settings);
  if (settings.batch > data.transitions())
    throw UsageError(fmt::format("batch {}: {} has {} transitions; take a smaller batch or more data", settings.batch,
                                 excerpt(data.source()), data.transitions()));
  const std::size_t inputs = data.scenario().observation_size(0);
  const std::size_t h = settings.hidden;
  actor_shape_ = NormalisedShape(MlpShape({inputs, h, h, 2}), 1);
  critic_shape_ = NormalisedShape(MlpShape({inputs + 2, h, h, 1}), 2);
  for (std::size_t agent = 0; agent < data.scenario().predators(); ++agent) {
    Predator predator;
    predator.actor = fresh(actor_shape_, settings.seed, agent, small_weights);
    predator.critic = fresh(critic_shape_, settings.seed, 100 + 10 * agent);
    predator.mean.assign(inputs, 0.0F);
    predator.variance.assign(inputs, 1.0F);
    predators_.push_back(std::move(predator));
    auto& work = *work_.emplace_back(std::make_unique<Work>());
    work.rows.resize(settings.batch);
    work.taken.resize(data.transitions());
    auto& batch = work.batch;
    for (Matrix<float>* matrix : {&batch.observations, &batch.next_observations})
      matrix->resize(index(settings.batch), index(inputs));
    batch.actions.resize(index(settings.batch), 2);
    for (Matrix<float>* matrix : {&batch.rewards, &batch.dones}) matrix->resize(index(settings.batch), 1);
  }
}

OmarLearner::~OmarLearner() = default;

OmarLearner::Network OmarLearner::fresh(const NormalisedShape& shape, std::uint64_t seed, std::uint64_t first,
                                        double last) {
  Network network;
  network.parameters = initial_parameters(shape, seed, first, last);
  network.target = network.parameters;
  network.optimiser.first.resize(shape.parameters());
  network.optimiser.second.resize(shape.parameters());
  return network;
}

/// Rows without replacement: one that the batch has is drawn again.
void OmarLearner::draw_batch(std::size_t agent) {
  Work& work = *work_[agent];
  RandomStream random = random_stream(settings_.seed, RandomUse::offline_batch, steps_, 0, agent);
  for (std::size_t& row : work.rows) {
    do row = static_cast<std::size_t>(random() % data_.transitions());
    while (work.taken[row]);
    work.taken[row] = true;
  }
  for (const std::size_t row : work.rows) work.taken[row] = false;
  auto& batch = work.batch;
  const std::size_t inputs = actor_shape_.inputs();
  for (std::size_t r = 0; r < work.rows.size(); ++r) {
    const std::size_t row = work.rows[r];
    data_.observation(agent, row, {batch.observations.data() + r * inputs, inputs});
    data_.next_observation(agent, row, {batch.next_observations.data() + r * inputs, inputs});
    data_.action(agent, row, std::span<float, 2>(batch.actions.data() + 2 * r, 2));
    batch.rewards.data()[r] = data_.reward(agent, row);
    batch.dones.data()[r] = data_.done(agent, row) ? 1.0F : 0.0F;
  }
}

/// An Adam step along the gradient, then one of the target.
void OmarLearner::descend(Network& network, std::vector<float>& gradient) const {
  const std::pair<std::size_t, std::size_t> everything{0, gradient.size()};
  sct::adamw_step<float>(adam(settings_.learning_rate, settings_.clip), std::span(&everything, 1), gradient,
                         network.optimiser, network.parameters);
  const float tau = static_cast<float>(settings_.averaging);
  for (std::size_t i = 0; i < network.target.size(); ++i)
    network.target[i] = network.target[i] * (1 - tau) + network.parameters[i] * tau;
}

void OmarLearner::update(std::size_t agent) {
  Work& work = *work_[agent];
  Predator& predator = predators_[agent];
  Network& actor = predator.actor;
  Network& critic = predator.critic;
  auto& scratch = work.scratch;
  draw_batch(agent);
  RandomStream random = random_stream(settings_.seed, RandomUse::candidates, steps_, 0, agent);

  critic_targets(actor_shape_, actor.target.data(), critic_shape_, critic.target.data(), work.batch, settings_.discount,
                 scratch, work.targets);
  draw_uniform_actions(random, settings_.batch * uniform_actions_each, work.uniform);
  work.gradient.assign(critic_shape_.parameters(), 0.0F);
  work.critic_loss = critic_loss(critic_shape_, critic.parameters.data(), work.batch, work.targets, work.uniform,
                                 settings_.conservatism, scratch, work.gradient.data());
  descend(critic, work.gradient);

  act(actor_shape_, actor.parameters.data(), critic_shape_, critic.parameters.data(), work.batch.observations, scratch);
  remember_batch(scratch.actor.norm, predator.mean, predator.variance);
  const double imitation = settings_.cql ? 0 : settings_.imitation;
  if (imitation > 0)
    search_actions<float>(first_critic(critic_shape_, critic.parameters.data(), work.batch.observations, scratch),
                          scratch.actions, scratch.critic.output(0), random, work.best);
  work.gradient.assign(actor_shape_.parameters(), 0.0F);
  work.actor_loss = actor_loss(actor_shape_, actor.parameters.data(), critic_shape_, critic.parameters.data(),
                               work.best, imitation, scratch, work.gradient.data());
  descend(actor, work.gradient);
}

std::vector<NamedLoss> OmarLearner::step() {
  workers_.run(predators_.size(), [&](std::size_t agent, unsigned) { update(agent); });
  ++steps_;
  std::vector<NamedLoss> losses{{"critic", 0}, {"conservative", 0}, {"actor", 0}};
  for (const auto& work : work_) {
    const double share = 1 / static_cast<double>(work_.size());
    losses[0].value += share * work->critic_loss.error;
    losses[1].value += share * work->critic_loss.conservative;
    losses[2].value += share * work->actor_loss;
  }
  return losses;
}

void OmarLearner::save(sct::RecordWriter& writer) const {
  writer.word(steps_);
  for (const auto& predator : predators_) {
    for (const Network* network : {&predator.actor, &predator.critic}) {
      writer.floats(network->parameters);
      writer.floats(network->target);
      writer.word(network->optimiser.steps);
      writer.floats(network->optimiser.first);
      writer.floats(network->optimiser.second);
    }
    writer.floats(predator.mean);
    writer.floats(predator.variance);
  }
}

void OmarLearner::load(sct::RecordReader& reader) {
  const std::uint64_t steps = reader.steps();
  std::vector<Predator> predators(predators_.size());
  for (auto& predator : predators) {
    for (Network* network : {&predator.actor, &predator.critic}) {
      network->parameters = reader.floats();
      network->target = reader.floats();
      network->optimiser.steps = reader.steps();
      network->optimiser.first = reader.floats();
      network->optimiser.second = reader.floats();
    }
    predator.mean = reader.floats();
    predator.variance = reader.floats();
    require_fit(reader, predator);
  }
  predators_ = std::move(predators);
  steps_ = steps;
}

void OmarLearner::require_fit(const sct::RecordReader& reader, const Predator& read) const {
  const auto fits = [](const Network& network, const NormalisedShape& shape) {
    const std::size_t size = shape.parameters();
    return network.parameters.size() == size && network.target.size() == size &&
           network.optimiser.first.size() == size && network.optimiser.second.size() == size;
  };
  const std::size_t inputs = actor_shape_.inputs();
  if (!fits(read.actor, actor_shape_) || !fits(read.critic, critic_shape_) || read.mean.size() != inputs ||
      read.variance.size() != inputs)
    reader.refuse("a checkpoint of other networks; resume with the settings it was made with");
  const auto negative = [](float number) { return number < 0; };
  for (const auto* numbers : {&read.variance, &read.actor.optimiser.second, &read.critic.optimiser.second})
    if (std::any_of(numbers->begin(), numbers->end(), negative)) reader.wrong("a mean square below 0");
}

std::string OmarLearner::description() const {
  const auto& s = settings_;
  std::string text = fmt::format("learner = {}\nconservatism = {}\n", s.cql ? "cql" : "omar", s.conservatism);
  if (!s.cql) text += fmt::format("imitation = {}\n", s.imitation);
  return text + fmt::format(
                    "hidden = {}\nlearning-rate = {}\nbatch = {}\ndiscount = {}\naveraging = {}\nclip = {}\n"
                    "seed = {}\n",
                    s.hidden, s.learning_rate, s.batch, s.discount, s.averaging, s.clip, s.seed);
}

std::string OmarLearner::policy(const std::map<std::string, std::string>& notes) const {
  Policy policy{data_.scenario().name, Side::predators, {}, notes};
  for (const auto& predator : predators_) {
    const float* numbers = predator.actor.parameters.data();
    const std::size_t inputs = actor_shape_.inputs();
    PolicyNetwork network;
    network.shape = actor_shape_.network();
    network.parameters.assign(numbers + actor_shape_.network_begin(0), numbers + actor_shape_.parameters());
    InputNormalisation normalisation;
    normalisation.weight.assign(numbers, numbers + inputs);
    normalisation.bias.assign(numbers + actor_shape_.bias(), numbers + actor_shape_.bias() + inputs);
    normalisation.mean = predator.mean;
    normalisation.variance = predator.variance;
    normalisation.epsilon = batch_norm_epsilon;
    network.normalisation = std::move(normalisation);
    policy.networks.push_back(std::move(network));
  }
  return policy_bytes(policy);
}

}  // namespace folk::mpe
