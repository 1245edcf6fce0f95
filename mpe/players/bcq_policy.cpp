#include <folk/games/error.h>
#include <folk/mpe/network/policy_network.h>
#include <folk/mpe/players/bcq_policy.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <utility>

namespace folk::mpe {
namespace {

constexpr std::size_t most_candidates = 10'000;
constexpr double largest_perturbation = 2;  // from one end of [-1, 1] to the other
constexpr double largest_latent = 0.5;

/// Rows that are computed together: as many as keep the layers in the cache.
constexpr std::size_t rows_together = 256;

std::string agent_prefix(std::size_t agent, const char* network) { return fmt::format("agent{}.{}.", agent, network); }

/// A word of the metadata that is a number up to `most`.
template <class Number>
Number take_number(PolicyReader& reader, const char* key, Number least, Number most) {
  const std::string word = reader.take_word(key);
  Number number{};
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (error != std::errc() || stop != end || !(number >= least && number <= most))
    reader.refuse(fmt::format("{} '{}': expected a number from {} to {}", key, excerpt(word), least, most));
  return number;
}

/// A network of which the widths of both ends are known; `inputs` 0: any.
StoredNetwork take_part(PolicyReader& reader, std::size_t agent, const char* part, std::size_t inputs,
                        std::size_t outputs) {
  StoredNetwork network = take_stored_network(reader, agent_prefix(agent, part));
  if (network.shape.outputs() != outputs)
    reader.refuse(
        fmt::format("the {} of agent{} has {} outputs: expected {}", part, agent, network.shape.outputs(), outputs));
  if (inputs != 0 && network.shape.inputs() != inputs)
    reader.refuse(fmt::format("the {} of agent{} has {} inputs: expected {}, what is observed and an action", part,
                              agent, network.shape.inputs(), inputs));
  return network;
}

BcqNetworks take_networks(PolicyReader& reader, std::size_t agent, std::size_t observed) {
  BcqNetworks networks;
  networks.decoder = take_part(reader, agent, "decoder", 0, 2);
  if (networks.decoder.shape.inputs() <= observed)
    reader.refuse(fmt::format("the decoder of agent{} has {} inputs: expected more than {}, what is observed", agent,
                              networks.decoder.shape.inputs(), observed));
  networks.perturbation = take_part(reader, agent, "perturbation", observed + 2, 2);
  networks.critic = take_part(reader, agent, "critic", observed + 2, 1);
  return networks;
}

NetworkView<float> view(const StoredNetwork& network) { return {network.shape, network.parameters.data()}; }

class BcqPlayer final : public Player {
public:
  BcqPlayer(std::shared_ptr<const BcqPolicy> policy, std::size_t agent)
      : policy_(std::move(policy)),
        networks_(policy_->networks[agent]) {}

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    const std::size_t together = std::max<std::size_t>(1, rows_together / policy_->candidates);
    for (std::size_t lane = 0; lane < block.lanes; lane += together)
      act_in(layout, block, agent, moment, lane, std::min(together, block.lanes - lane));
  }

private:
  void act_in(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment, std::size_t first,
              std::size_t lanes) {
    const std::size_t candidates = policy_->candidates;
    tape_.decoder.prepare(networks_.decoder.shape, lanes * candidates);
    Matrix<float>& input = tape_.decoder.input();
    const std::size_t observed = layout.scenario().observation_size(agent);
    const double* observations = block.observations + layout.observation_begin(agent) * block_lanes;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      RandomStream random =
          random_stream(moment.seed, RandomUse::policy, moment.first + first + lane, moment.step, agent);
      for (std::size_t i = 0; i < candidates; ++i) {
        float* row = input.data() + (lane * candidates + i) * networks_.decoder.shape.inputs();
        for (std::size_t k = 0; k < observed; ++k)
          row[k] = static_cast<float>(observations[k * block_lanes + first + lane]);
        draw_latent(random, row + observed, networks_.decoder.shape.inputs() - observed);
      }
    }
    propose(view(networks_.decoder), view(networks_.perturbation), static_cast<float>(policy_->perturbation), tape_);
    critic_.prepare(networks_.critic.shape, tape_.judged);
    forward(networks_.critic.shape, networks_.critic.parameters.data(), critic_);
    const auto [x, y] = action_rows(block, agent);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const float* values = critic_.output().data() + lane * candidates;
      const auto best = std::max_element(values, values + candidates) - critic_.output().data();
      x[first + lane] = static_cast<double>(tape_.judged(best, index(observed)));
      y[first + lane] = static_cast<double>(tape_.judged(best, index(observed) + 1));
    }
  }

  std::shared_ptr<const BcqPolicy> policy_;
  const BcqNetworks& networks_;
  CandidateTape<float> tape_;
  MlpTape<float> critic_;
};

}  // namespace

template <class S>
void propose(NetworkView<S> decoder, NetworkView<S> perturbation, S most, CandidateTape<S>& tape) {
  forward(decoder.shape, decoder.parameters, tape.decoder);
  squash(Squash::tanh, tape.decoder.output(), tape.squashed);
  const Matrix<S>& drawn = tape.decoder.input();
  tape.perturbation.prepare(perturbation.shape, static_cast<std::size_t>(drawn.rows()));
  Matrix<S>& input = tape.perturbation.input();
  input.leftCols(input.cols() - 2) = drawn.leftCols(input.cols() - 2);
  input.rightCols(2) = tape.squashed;
  forward(perturbation.shape, perturbation.parameters, tape.perturbation);
  squash(Squash::tanh, tape.perturbation.output(), tape.shifts);
  tape.judged = input;
  tape.judged.rightCols(2) = (tape.squashed + most * tape.shifts).array().max(S(-1)).min(S(1));
}

template void propose(NetworkView<float>, NetworkView<float>, float, CandidateTape<float>&);
template void propose(NetworkView<double>, NetworkView<double>, double, CandidateTape<double>&);

void draw_latent(RandomStream& random, float* numbers, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    numbers[i] = static_cast<float>(std::clamp(random.normal(), -largest_latent, largest_latent));
}

BcqPolicy parse_bcq_policy(std::string_view bytes, const std::string& source) {
  PolicyReader reader(bytes, source);
  BcqPolicy policy;
  if (const auto format = reader.take_word("format"); format != bcq_policy_format)
    reader.refuse(fmt::format("format '{}': expected {}", excerpt(format), bcq_policy_format));
  policy.scenario = reader.take_word("scenario");
  policy.candidates = take_number<std::size_t>(reader, "candidates", 1, most_candidates);
  policy.perturbation = take_number<double>(reader, "perturbation", 0, largest_perturbation);
  policy.notes = reader.metadata();
  Scenario scenario;
  try {
    scenario = Scenario::named(policy.scenario);
  } catch (const UsageError& error) {
    reader.refuse(error.what());
  }
  for (std::size_t agent = 0; agent < scenario.predators(); ++agent)
    policy.networks.push_back(take_networks(reader, agent, scenario.observation_size(agent)));
  reader.require_nothing_left();
  return policy;
}

std::string bcq_policy_bytes(const BcqPolicy& policy) {
  auto metadata = policy.notes;
  metadata["format"] = bcq_policy_format;
  metadata["scenario"] = policy.scenario;
  metadata["candidates"] = fmt::to_string(policy.candidates);
  metadata["perturbation"] = fmt::to_string(policy.perturbation);
  PolicyWriter writer;
  for (std::size_t agent = 0; agent < policy.networks.size(); ++agent) {
    const auto& networks = policy.networks[agent];
    const auto add = [&](const char* part, const StoredNetwork& network) {
      writer.add(agent_prefix(agent, part), network.shape, network.parameters);
    };
    add("decoder", networks.decoder);
    add("perturbation", networks.perturbation);
    add("critic", networks.critic);
  }
  std::string bytes = writer.bytes(metadata);
  try {
    parse_bcq_policy(bytes, "policy");
  } catch (const InputFileError& error) {
    throw UsageError(fmt::format("a policy that could not be read again: {}", error.what()));
  }
  return bytes;
}

Controller bcq_controller(std::string name, BcqPolicy policy, const Scenario& scenario) {
  if (policy.scenario != scenario.name)
    throw UsageError(
        fmt::format("{}: a policy for {}, not for {}", excerpt(name, 1000), policy.scenario, scenario.name));
  const auto shared = std::make_shared<const BcqPolicy>(std::move(policy));
  return {name, each([name, shared](const Layout& layout, std::size_t agent) {
            const std::size_t judged = layout.scenario().observation_size(agent) + 2;
            if (side_of(layout, agent) == Side::prey)
              throw UsageError(fmt::format("{}: a policy of the predators, not of the prey", excerpt(name, 1000)));
            if (agent >= shared->networks.size() || shared->networks[agent].critic.shape.inputs() != judged)
              throw UsageError(fmt::format("{}: has no networks for agent {}, who observes {} numbers",
                                           excerpt(name, 1000), agent, judged - 2));
            return std::make_unique<BcqPlayer>(shared, agent);
          })};
}

}  // namespace folk::mpe
