#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/players/policy_tensors.h>

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

namespace folk::mpe {
namespace {

constexpr std::array scenario_names = {"simple_tag", "simple_world"};

/// Which scenario and side a network of this many inputs is for.
std::optional<std::pair<std::string, Side>> meant_for(std::size_t inputs) {
  for (const std::string name : scenario_names) {
    const auto scenario = Scenario::named(name);
    if (inputs == scenario.observation_size(0)) return std::pair{name, Side::predators};
    if (inputs == scenario.observation_size(scenario.prey())) return std::pair{name, Side::prey};
  }
  return std::nullopt;
}

/// Names of its tensors, in the order of InputNormalisation.
using NormalisationNames = std::array<std::string, 4>;

/// Names of the tensors of a network in Folk's own form.
NormalisationNames normalisation_names(const std::string& prefix) {
  return {prefix + "norm.weight", prefix + "norm.bias", prefix + "norm.mean", prefix + "norm.variance"};
}

/// Takes a normalisation of so many inputs where the file has the first of its tensors.
std::optional<InputNormalisation> take_normalisation(PolicyReader& reader, std::size_t inputs,
                                                     const NormalisationNames& names) {
  if (!reader.has(names[0])) return std::nullopt;
  const TensorShape shape{inputs};
  InputNormalisation normalisation;
  normalisation.weight = reader.take(names[0], shape);
  normalisation.bias = reader.take(names[1], shape);
  normalisation.mean = reader.take(names[2], shape);
  normalisation.variance = reader.take(names[3], shape);
  for (const float variance : normalisation.variance)
    if (variance < 0) reader.refuse(fmt::format("tensor '{}' holds a number below 0", names[3]));
  return normalisation;
}

void add_normalisation(PolicyWriter& writer, const std::string& prefix, std::size_t inputs,
                       const InputNormalisation& normalisation) {
  if (normalisation.epsilon != InputNormalisation{}.epsilon)
    throw UsageError(fmt::format("a normalisation with an epsilon of {} has no place in this format, which has {}",
                                 normalisation.epsilon, InputNormalisation{}.epsilon));
  const auto names = normalisation_names(prefix);
  const TensorShape shape{inputs};
  writer.add(names[0], shape, normalisation.weight);
  writer.add(names[1], shape, normalisation.bias);
  writer.add(names[2], shape, normalisation.mean);
  writer.add(names[3], shape, normalisation.variance);
}

Policy published_policy(PolicyReader& reader) {
  Policy policy;
  PolicyNetwork network = take_network(reader, "");
  const std::size_t inputs = network.shape.inputs();
  network.normalisation =
      take_normalisation(reader, inputs, {"in_fn.weight", "in_fn.bias", "in_fn.running_mean", "in_fn.running_var"});
  if (network.normalisation) reader.forget("in_fn.num_batches_tracked");
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

Policy folk_policy(PolicyReader& reader) {
  Policy policy;
  if (const auto format = reader.take_word("format"); format != policy_format)
    reader.refuse(fmt::format("format '{}': this Folk reads {}", excerpt(format), policy_format));
  policy.scenario = reader.take_word("scenario");
  const auto side = reader.take_word("side");
  const auto squash = reader.take_word("squash");
  policy.notes = reader.metadata();
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
    const std::string prefix = fmt::format("agent{}.", agent);
    policy.networks.push_back(take_network(reader, prefix));
    policy.networks.back().squash = squash == "tanh" ? Squash::tanh : Squash::clamp;
    if (policy.networks.back().shape.inputs() != inputs)
      reader.refuse(fmt::format("agent{} has {} inputs: the {} of {} observe {} numbers", agent,
                                policy.networks.back().shape.inputs(), side, policy.scenario, inputs));
    policy.networks.back().normalisation = take_normalisation(reader, inputs, normalisation_names(prefix));
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
  PolicyReader reader(bytes, source);
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
  PolicyWriter writer;
  for (std::size_t agent = 0; agent < policy.networks.size(); ++agent) {
    const auto& network = policy.networks[agent];
    if (network.squash != policy.networks.front().squash)
      throw UsageError("a policy of two kinds of actions has no place in this format");
    const std::string prefix = fmt::format("agent{}.", agent);
    if (network.normalisation) add_normalisation(writer, prefix, network.shape.inputs(), *network.normalisation);
    writer.add(prefix, network.shape, network.parameters);
  }
  std::string bytes = writer.bytes(metadata);
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
  return {name, each([name, networks = std::move(policy.networks)](const Layout& layout, std::size_t agent) {
            const std::size_t which = networks.size() == 1 ? 0 : agent;
            const std::size_t observed = layout.scenario().observation_size(agent);
            if (which >= networks.size() || networks[which].shape.inputs() != observed)
              throw UsageError(fmt::format("{}: has no network for agent {}, who observes {} numbers",
                                           excerpt(name, 1000), agent, observed));
            return std::make_unique<NetworkPlayer>(networks[which]);
          })};
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
