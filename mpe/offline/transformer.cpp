#include <folk/games/error.h>
#include <folk/mpe/data/observation_scale.h>
#include <folk/mpe/network/setting_ranges.h>
#include <folk/mpe/offline/transformer.h>
#include <folk/mpe/offline/transformer_windows.h>
#include <folk/sct/network/initial_parameters.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace folk::mpe {
namespace {

sct::Architecture architecture_of(const Scenario& scenario, const TransformerSettings& settings) {
  sct::Architecture architecture;
  architecture.hidden = settings.hidden;
  architecture.layers = settings.layers;
  architecture.heads = settings.heads;
  architecture.context = settings.context;
  architecture.readout = settings.readout;
  architecture.belief_token = settings.belief_token;
  return particle_architecture(scenario, architecture);
}

const TransformerSettings& sound(const TransformerSettings& settings) {
  const auto& optimiser = settings.optimiser;
  require_count("batch", settings.batch, 1, 1 << 16);
  require_number("dropout", settings.dropout, 0, 0.99);
  require_number("return-scale", settings.return_scale, 1e-9, 1e9);
  require_number("learning-rate", optimiser.learning_rate, 1e-9, 1);
  require_number("weight-decay", optimiser.weight_decay, 0, 1);
  require_number("clip", optimiser.clip, 1e-9, 1e9);
  return settings;
}

double mean_return(const DataSet& data) {
  double sum = 0;
  for (std::size_t row = 0; row < data.transitions(); ++row) sum += static_cast<double>(data.reward(0, row));
  return sum / static_cast<double>(data.episodes());
}

}  // namespace

TransformerSettings madt(TransformerSettings base) {
  base.mode = sct::LossMode::action_only;
  base.readout = sct::Readout::own;
  base.belief_token = false;
  return base;
}

TransformerSettings rmadt(TransformerSettings base) {
  base.mode = sct::LossMode::teacher;
  base.readout = sct::Readout::own;
  base.belief_token = true;
  return base;
}

TransformerLearner::TransformerLearner(const DataSet& data, const TransformerSettings& settings)
    : data_(data),
      settings_(sound(settings)),
      scale_(measured_scale(data, settings.threads)),
      mean_return_(mean_return(data)),
      network_(std::make_unique<sct::Network<float>>(architecture_of(data.scenario(), settings))),
      gradient_of_(*network_, settings.mode, std::max(1U, settings.threads)),
      parameters_(sct::initial_parameters(network_->architecture(), settings.seed)),
      gradient_(parameters_.size()) {
  optimiser_.first.resize(parameters_.size());
  optimiser_.second.resize(parameters_.size());
}

std::vector<NamedLoss> TransformerLearner::step() {
  const std::uint64_t now = steps();
  const auto batch =
      draw_windows(data_, scale_, settings_.return_scale, settings_.batch, settings_.context, settings_.seed, now);
  const auto losses = gradient_of_(parameters_, batch, {settings_.dropout, settings_.seed, now}, gradient_);
  sct::adamw_step<float>(settings_.optimiser, gradient_of_.touched(), gradient_, optimiser_, parameters_);
  return {{"belief", losses.belief}, {"action", losses.action}};
}

void TransformerLearner::save(sct::RecordWriter& writer) const {
  writer.word(optimiser_.steps);
  for (const auto* numbers : {&parameters_, &optimiser_.first, &optimiser_.second}) writer.floats(*numbers);
}

void TransformerLearner::load(sct::RecordReader& reader) {
  sct::AdamWState<float> optimiser;
  optimiser.steps = reader.steps();
  auto parameters = reader.floats();
  optimiser.first = reader.floats();
  optimiser.second = reader.floats();
  for (const auto* numbers : {&parameters, &optimiser.first, &optimiser.second})
    if (numbers->size() != parameters_.size()) reader.wrong("a network of another size");
  for (const float square : optimiser.second)
    if (square < 0) reader.wrong("a mean square below 0");
  parameters_ = std::move(parameters);
  optimiser_ = std::move(optimiser);
}

std::string TransformerLearner::description() const {
  const auto& s = settings_;
  const auto& o = s.optimiser;
  return fmt::format(
      "loss = {}\nreadout = {}\nbelief-token = {}\nhidden = {}\nlayers = {}\nheads = {}\ncontext = {}\nbatch = {}\n"
      "dropout = {}\nreturn-scale = {}\nlearning-rate = {}\nweight-decay = {}\nclip = {}\nwarmup = {}\n"
      "decay-steps = {}\nseed = {}\n",
      to_string(s.mode), to_string(s.readout), s.belief_token, s.hidden, s.layers, s.heads, s.context, s.batch,
      s.dropout, s.return_scale, o.learning_rate, o.weight_decay, o.clip, o.warmup_steps, o.decay_steps, s.seed);
}

TransformerPolicy TransformerLearner::trained() const {
  TransformerPolicy policy;
  policy.scenario = data_.scenario().name;
  policy.architecture = network_->architecture();
  policy.mode = settings_.mode;
  policy.parameters = parameters_;
  policy.scale = scale_;
  policy.return_scale = settings_.return_scale;
  policy.return_target = mean_return_;
  return policy;
}

std::string TransformerLearner::policy(const std::map<std::string, std::string>& notes) const {
  auto policy = trained();
  policy.notes = notes;
  return transformer_policy_bytes(policy);
}

}  // namespace folk::mpe
