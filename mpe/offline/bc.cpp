#include <folk/games/error.h>
#include <folk/mpe/data/observation_scale.h>
#include <folk/mpe/network/setting_ranges.h>
#include <folk/mpe/offline/bc.h>
#include <folk/mpe/world/random_stream.h>
#include <folk/sct/network/dropout.h>

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace folk::mpe {
namespace {

const BcSettings& sound(const BcSettings& settings) {
  require_sound(settings);
  return settings;
}

MlpShape network_shape(const Scenario& scenario, const BcSettings& settings) {
  std::vector<std::size_t> widths{settings.context * team_observation_size(scenario)};
  widths.resize(1 + settings.layers, settings.hidden);
  widths.push_back(2 * scenario.predators());
  return MlpShape(widths);
}

sct::AdamWSettings optimiser_settings(const BcSettings& settings) {
  sct::AdamWSettings adamw;
  adamw.learning_rate = settings.learning_rate;
  adamw.weight_decay = settings.weight_decay;
  adamw.clip = settings.clip;
  adamw.warmup_steps = settings.warmup_steps;
  adamw.decay_steps = settings.decay_steps;
  return adamw;
}

}  // namespace

void require_sound(const BcSettings& settings) {
  require_count("context", settings.context, 1, 50);  // a policy file's layers have at most 4096 inputs
  require_count("hidden", settings.hidden, 1, 4096);
  require_count("layers", settings.layers, 1, 15);
  require_number("dropout", settings.dropout, 0, 0.99);
  require_count("batch", settings.batch, 1, 1 << 20);
  require_number("learning-rate", settings.learning_rate, 1e-9, 1);
  require_number("weight-decay", settings.weight_decay, 0, 1);
  require_count("warmup-steps", settings.warmup_steps, 0, 1'000'000'000);
  require_count("decay-steps", settings.decay_steps, 0, 1'000'000'000);
  require_number("clip", settings.clip, 1e-9, 1e9);
  require_count("threads", settings.threads, 1, 4096);
}

BcLearner::BcLearner(const DataSet& data, const BcSettings& settings)
    : data_(data),
      settings_(sound(settings)),
      scale_(measured_scale(data, settings.threads)),
      shape_(network_shape(data.scenario(), settings)),
      parameters_(initial_parameters(shape_, settings.seed, 0)),
      gradient_(shape_.parameters()),
      workers_(settings.threads) {
  optimiser_.first.resize(shape_.parameters());
  optimiser_.second.resize(shape_.parameters());
  const Index rows = index(settings.batch);
  examples_.windows.resize(rows, index(shape_.inputs()));
  examples_.padding.resize(settings.batch);
  examples_.actions.resize(rows, index(shape_.outputs()));
  examples_.dropout.assign(settings.layers, Matrix<float>::Ones(rows, index(settings.hidden)));
}

std::vector<NamedLoss> BcLearner::step() {
  draw_examples();
  draw_dropout();
  const double loss = bc_loss(shape_, parameters_.data(), examples_, tape_, gradient_.data(), workers_);
  const std::pair<std::size_t, std::size_t> everything{0, parameters_.size()};
  sct::adamw_step<float>(optimiser_settings(settings_), std::span(&everything, 1), gradient_, optimiser_, parameters_);
  return {{"action", loss}};
}

/// Those of the longest windows first.
void BcLearner::draw_examples() {
  std::vector<Ending> endings(settings_.batch);
  RandomStream random = random_stream(settings_.seed, RandomUse::offline_batch, steps());
  for (auto& [episode, last] : endings) {
    episode = static_cast<std::size_t>(random() % data_.episodes());
    last = static_cast<std::size_t>(random() % data_.episode_steps());
  }
  std::stable_sort(endings.begin(), endings.end(), [](const auto& a, const auto& b) { return a.last > b.last; });
  for (std::size_t row = 0; row < endings.size(); ++row) {
    if (row + 1 < endings.size()) expect(endings[row + 1]);
    gather(index(row), endings[row]);
  }
}

BcLearner::Rows BcLearner::rows_of(const Ending& ending) const {
  const std::size_t end = ending.episode * data_.episode_steps() + ending.last + 1;
  return {end - std::min(ending.last + 1, settings_.context), end};
}

/// Windows lie all over the data: the next one's numbers are asked for while those of the one before are copied.
void BcLearner::expect(const Ending& ending) const {
  const auto [first, end] = rows_of(ending);
  for (std::size_t predator = 0; predator < data_.scenario().predators(); ++predator) {
    const std::string_view bytes = data_.table(DataField::observation, predator).bytes(first, end);
    for (std::size_t at = 0; at < bytes.size(); at += 64) __builtin_prefetch(bytes.data() + at);
    __builtin_prefetch(data_.table(DataField::action, predator).bytes(end - 1, end).data());
  }
}

void BcLearner::gather(Index row, const Ending& ending) {
  const auto [first, end] = rows_of(ending);
  const std::size_t steps = end - first;
  const std::size_t width = shape_.inputs() / settings_.context;
  const std::size_t padding = (settings_.context - steps) * width;
  examples_.padding[static_cast<std::size_t>(row)] = index(padding);
  float* window = examples_.windows.row(row).data();
  std::fill_n(window, padding, 0.0F);
  std::size_t begin = padding;  // of a predator in the first step
  for (std::size_t predator = 0; predator < data_.scenario().predators(); ++predator) {
    const std::size_t size = data_.scenario().observation_size(predator);
    for (std::size_t k = 0; k < steps; ++k) {
      const std::span numbers(window + begin + k * width, size);
      data_.observation(predator, first + k, numbers);
      scale_.apply(predator, numbers);
    }
    begin += size;
    const std::span<float, 2> action(&examples_.actions(row, index(2 * predator)), 2);
    data_.action(predator, end - 1, action);
  }
}

void BcLearner::draw_dropout() {
  const sct::Dropout dropout(settings_.dropout, settings_.seed, steps());
  if (!dropout.active()) return;
  const float kept = static_cast<float>(dropout.scale());
  std::vector<std::uint8_t> keep(settings_.hidden);
  for (std::size_t layer = 0; layer < examples_.dropout.size(); ++layer)
    for (std::size_t row = 0; row < settings_.batch; ++row) {
      dropout.keep(keep.data(), keep.size(), row, layer);
      float* factors = examples_.dropout[layer].row(index(row)).data();
      for (std::size_t i = 0; i < keep.size(); ++i) factors[i] = keep[i] != 0 ? kept : 0.0F;
    }
}

void BcLearner::save(sct::RecordWriter& writer) const {
  writer.floats(parameters_);
  writer.word(optimiser_.steps);
  writer.floats(optimiser_.first);
  writer.floats(optimiser_.second);
}

void BcLearner::load(sct::RecordReader& reader) {
  std::vector<float> parameters = reader.floats();
  sct::AdamWState<float> optimiser;
  optimiser.steps = reader.steps();
  optimiser.first = reader.floats();
  optimiser.second = reader.floats();
  for (const auto* numbers : {&parameters, &optimiser.first, &optimiser.second})
    if (numbers->size() != shape_.parameters())
      reader.refuse("a checkpoint of another network; resume with the settings it was made with");
  parameters_ = std::move(parameters);
  optimiser_ = std::move(optimiser);
}

std::string BcLearner::description() const {
  const auto& s = settings_;
  return fmt::format(
      "algorithm = bc\nscenario = {}\ncontext = {}\nhidden = {}\nlayers = {}\ndropout = {}\nbatch = {}\n"
      "learning-rate = {}\nweight-decay = {}\nwarmup-steps = {}\ndecay-steps = {}\nclip = {}\nseed = {}\n",
      data_.scenario().name, s.context, s.hidden, s.layers, s.dropout, s.batch, s.learning_rate, s.weight_decay,
      s.warmup_steps, s.decay_steps, s.clip, s.seed);
}

std::string BcLearner::policy(const std::map<std::string, std::string>& notes) const {
  return window_policy_bytes({data_.scenario().name, settings_.context, scale_, shape_, parameters_, notes});
}

}  // namespace folk::mpe
