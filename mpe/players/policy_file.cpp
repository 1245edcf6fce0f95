#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/sct/little_endian.h>
#include <folk/sct/safetensors.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

namespace folk::mpe {
namespace {

constexpr std::size_t most_layers = 16;
constexpr std::size_t widest_layer = 4096;
constexpr std::array scenario_names = {"simple_tag", "simple_world"};

using Shape = std::vector<std::uint64_t>;

/// Takes tensors out of a file by name, so that what is left at the end was not asked for.
class Reader {
public:
  Reader(sct::SafetensorsFile file, const std::string& source)
      : file_(std::move(file)),
        source_(source) {}

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputFileError(fmt::format("{}: {}", excerpt(source_, 1000), why));
  }

  const std::map<std::string, std::string>& metadata() const { return file_.metadata; }
  bool has(const std::string& name) const { return file_.tensors.contains(name); }
  const Shape& shape(const std::string& name) const {
    const auto found = file_.tensors.find(name);
    if (found == file_.tensors.end()) refuse(fmt::format("tensor '{}' is missing; it is no policy of this form", name));
    return found->second.shape;
  }

  std::vector<float> take(const std::string& name, const Shape& wanted) {
    const Shape& there = shape(name);
    if (there != wanted)
      refuse(fmt::format("tensor '{}' has shape ({}): expected ({})", name, fmt::join(there, ", "),
                         fmt::join(wanted, ", ")));
    const auto& tensor = file_.tensors.at(name);
    if (tensor.dtype != "F32")
      refuse(fmt::format("tensor '{}' has type {}: expected F32; convert it", name, excerpt(tensor.dtype)));
    std::uint64_t count = 1;
    for (const auto size : wanted) count *= size;
    if (tensor.data.size() != count * sizeof(float))
      refuse(fmt::format("tensor '{}' has {} bytes: expected {}", name, tensor.data.size(), count * sizeof(float)));
    std::vector<float> numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
      numbers[i] = std::bit_cast<float>(sct::load_little_endian<std::uint32_t>(tensor.data.substr(i * sizeof(float))));
      if (!std::isfinite(numbers[i])) refuse(fmt::format("tensor '{}' holds a number that is not finite", name));
    }
    file_.tensors.erase(name);
    return numbers;
  }

  void forget(const std::string& name) { file_.tensors.erase(name); }

  void require_nothing_left() const {
    if (!file_.tensors.empty())
      refuse(fmt::format("tensor '{}' has no place in a policy", excerpt(file_.tensors.begin()->first)));
  }

private:
  sct::SafetensorsFile file_;
  const std::string& source_;
};

/// Layers prefix + "fc1", "fc2", ...
PolicyNetwork take_network(Reader& reader, const std::string& prefix) {
  const auto name = [&](std::size_t layer, const char* part) { return fmt::format("{}fc{}.{}", prefix, layer, part); };
  std::vector<std::size_t> widths;
  std::size_t layers = 0;
  while (layers == 0 || reader.has(name(layers + 1, "weight"))) {
    ++layers;
    const Shape& shape = reader.shape(name(layers, "weight"));
    if (layers > most_layers) reader.refuse(fmt::format("more than {} layers", most_layers));
    if (shape.size() != 2 || shape[0] == 0 || shape[1] == 0 || shape[0] > widest_layer || shape[1] > widest_layer ||
        (!widths.empty() && shape[1] != widths.back()))
      reader.refuse(fmt::format("tensor '{}' has shape ({}), which does not follow the layer before",
                                name(layers, "weight"), fmt::join(shape, ", ")));
    if (widths.empty()) widths.push_back(shape[1]);
    widths.push_back(shape[0]);
  }
  if (widths.back() != 2) reader.refuse(fmt::format("a network of {} outputs: expected 2, an action", widths.back()));
  PolicyNetwork network;
  network.shape = MlpShape(widths);
  network.parameters.resize(network.shape.parameters());
  for (std::size_t layer = 1; layer <= layers; ++layer) {
    const auto put = [&](const std::vector<float>& numbers, std::size_t offset) {
      std::copy(numbers.begin(), numbers.end(), network.parameters.begin() + static_cast<std::ptrdiff_t>(offset));
    };
    put(reader.take(name(layer, "weight"), {widths[layer], widths[layer - 1]}), network.shape.weight(layer - 1));
    put(reader.take(name(layer, "bias"), {widths[layer]}), network.shape.bias(layer - 1));
  }
  return network;
}

/// Which scenario and side a network of this many inputs is for.
std::optional<std::pair<std::string, Side>> meant_for(std::size_t inputs) {
  for (const std::string name : scenario_names) {
    const auto scenario = Scenario::named(name);
    if (inputs == scenario.observation_size(0)) return std::pair{name, Side::predators};
    if (inputs == scenario.observation_size(scenario.prey())) return std::pair{name, Side::prey};
  }
  return std::nullopt;
}

Policy published_policy(Reader& reader) {
  Policy policy;
  PolicyNetwork network = take_network(reader, "");
  const std::size_t inputs = network.shape.inputs();
  if (reader.has("in_fn.weight")) {
    const Shape shape{inputs};
    InputNormalisation normalisation;
    normalisation.weight = reader.take("in_fn.weight", shape);
    normalisation.bias = reader.take("in_fn.bias", shape);
    normalisation.mean = reader.take("in_fn.running_mean", shape);
    normalisation.variance = reader.take("in_fn.running_var", shape);
    for (const float variance : normalisation.variance)
      if (variance < 0) reader.refuse("tensor 'in_fn.running_var' holds a number below 0");
    reader.forget("in_fn.num_batches_tracked");
    network.normalisation = std::move(normalisation);
  }
  const auto meant = meant_for(inputs);
  if (!meant)
    reader.refuse(
        fmt::format("a network of {} inputs: no agent of simple_tag or simple_world observes so many", inputs));
  std::tie(policy.scenario, policy.side) = *meant;
  network.squash = policy.side == Side::prey ? Squash::clamp : Squash::tanh;
  policy.networks.push_back(std::move(network));
  policy.notes = reader.metadata();
  return policy;
}

Policy folk_policy(Reader& reader) {
  Policy policy;
  policy.notes = reader.metadata();
  const auto taken = [&](const char* key) {
    const auto found = policy.notes.find(key);
    if (found == policy.notes.end()) reader.refuse(fmt::format("metadata '{}' is missing", key));
    std::string value = std::move(found->second);
    policy.notes.erase(found);
    return value;
  };
  if (const auto format = taken("format"); format != policy_format)
    reader.refuse(fmt::format("format '{}': this Folk reads {}", excerpt(format), policy_format));
  policy.scenario = taken("scenario");
  const auto side = taken("side");
  const auto squash = taken("squash");
  if (side != "predators" && side != "prey")
    reader.refuse(fmt::format("side '{}': expected predators or prey", excerpt(side)));
  if (squash != "tanh" && squash != "clamp")
    reader.refuse(fmt::format("squash '{}': expected tanh or clamp", excerpt(squash)));
  policy.side = side == "prey" ? Side::prey : Side::predators;
  std::size_t inputs = 0;
  try {
    const auto scenario = Scenario::named(policy.scenario);
    inputs = scenario.observation_size(policy.side == Side::prey ? scenario.prey() : 0);
  } catch (const UsageError& error) {
    reader.refuse(error.what());
  }
  for (std::size_t agent = 0; agent == 0 || reader.has(fmt::format("agent{}.fc1.weight", agent)); ++agent) {
    policy.networks.push_back(take_network(reader, fmt::format("agent{}.", agent)));
    policy.networks.back().squash = squash == "tanh" ? Squash::tanh : Squash::clamp;
    if (policy.networks.back().shape.inputs() != inputs)
      reader.refuse(fmt::format("agent{} has {} inputs: the {} of {} observe {} numbers", agent,
                                policy.networks.back().shape.inputs(), side, policy.scenario, inputs));
  }
  const std::size_t most = policy.side == Side::prey ? 1 : Scenario::named(policy.scenario).predators();
  if (policy.networks.size() != 1 && policy.networks.size() != most)
    reader.refuse(fmt::format("{} networks: expected 1 or {}", policy.networks.size(), most));
  return policy;
}

class NetworkPlayer final : public Player {
public:
  explicit NetworkPlayer(const PolicyNetwork& network)
      : actor_(network) {}

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment&) override {
    auto& observations = actor_.observations(block.lanes);
    const double* row = block.observations + layout.observation_begin(agent) * block_lanes;
    for (Index k = 0; k < observations.cols(); ++k, row += block_lanes)
      for (std::size_t lane = 0; lane < block.lanes; ++lane)
        observations(index(lane), k) = static_cast<float>(row[lane]);
    const auto& actions = actor_.act();
    const auto [x, y] = action_rows(block, agent);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      x[lane] = static_cast<double>(actions(index(lane), 0));
      y[lane] = static_cast<double>(actions(index(lane), 1));
    }
  }

private:
  Actor<float> actor_;
};

}  // namespace

Policy parse_policy(std::string_view bytes, const std::string& source) {
  Reader reader(sct::parse_safetensors(bytes, source), source);
  Policy policy = reader.metadata().contains("format") ? folk_policy(reader) : published_policy(reader);
  reader.require_nothing_left();
  return policy;
}

Policy read_policy(const std::filesystem::path& path) {
  return parse_policy(read_file(path, largest_policy_file), path.string());
}

std::string policy_bytes(const Policy& policy) {
  if (policy.networks.empty()) throw UsageError("a policy without networks cannot be written");
  auto metadata = policy.notes;
  metadata["format"] = policy_format;
  metadata["scenario"] = policy.scenario;
  metadata["side"] = to_string(policy.side);
  metadata["squash"] = policy.networks.front().squash == Squash::tanh ? "tanh" : "clamp";
  std::vector<sct::TensorToStore> tensors;
  std::string data;
  for (std::size_t agent = 0; agent < policy.networks.size(); ++agent) {
    const auto& network = policy.networks[agent];
    if (network.normalisation || network.squash != policy.networks.front().squash)
      throw UsageError("a policy with a normalisation, or of two kinds of actions, has no place in this format");
    const auto& widths = network.shape.widths();
    for (std::size_t layer = 1; layer < widths.size(); ++layer) {
      const std::string name = fmt::format("agent{}.fc{}.", agent, layer);
      tensors.push_back({name + "weight", {widths[layer], widths[layer - 1]}, widths[layer] * widths[layer - 1] * 4});
      tensors.push_back({name + "bias", {widths[layer]}, widths[layer] * 4});
    }
    for (const float number : network.parameters)  // weight and bias of each layer follow each other there too
      sct::append_little_endian(data, std::bit_cast<std::uint32_t>(number));
  }
  std::string bytes = sct::safetensors_header(metadata, tensors) + data;
  try {
    parse_policy(bytes, "policy");
  } catch (const InputFileError& error) {
    throw UsageError(fmt::format("a policy that could not be read again: {}", error.what()));
  }
  return bytes;
}

void write_policy(const std::filesystem::path& path, const Policy& policy) { write_file(path, policy_bytes(policy)); }

Controller policy_controller(std::string name, Policy policy, Side side, const Scenario& scenario) {
  if (policy.scenario != scenario.name)
    throw UsageError(
        fmt::format("{}: a policy for {}, not for {}", excerpt(name, 1000), policy.scenario, scenario.name));
  if (policy.side != side)
    throw UsageError(fmt::format("{}: a policy of the {}, not of the {}", excerpt(name, 1000), to_string(policy.side),
                                 to_string(side)));
  return {name, [name, networks = std::move(policy.networks)](const Layout& layout, std::size_t agent) {
            const std::size_t which = networks.size() == 1 ? 0 : agent;
            const std::size_t observed = layout.scenario().observation_size(agent);
            if (which >= networks.size() || networks[which].shape.inputs() != observed)
              throw UsageError(fmt::format("{}: has no network for agent {}, who observes {} numbers",
                                           excerpt(name, 1000), agent, observed));
            return std::make_unique<NetworkPlayer>(networks[which]);
          }};
}

Policy untrained_policy(const Scenario& scenario, Side side, std::uint64_t seed, std::size_t hidden) {
  Policy policy{scenario.name, side, {}, {{"algorithm", "untrained"}, {"seed", fmt::to_string(seed)}}};
  const std::size_t agents = side == Side::prey ? 1 : scenario.predators();
  const std::size_t first = side == Side::prey ? scenario.prey() : 0;
  for (std::size_t agent = 0; agent < agents; ++agent) {
    PolicyNetwork network;
    network.shape = MlpShape({scenario.observation_size(first + agent), hidden, hidden, 2});
    network.parameters = initial_parameters(network.shape, seed, first + agent);
    policy.networks.push_back(std::move(network));
  }
  return policy;
}

std::string_view to_string(Side side) { return side == Side::prey ? "prey" : "predators"; }

}  // namespace folk::mpe
