#include <folk/games/error.h>
#include <folk/mpe/network/policy_network.h>
#include <folk/mpe/players/policy_tensors.h>
#include <folk/mpe/players/window_policy.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace folk::mpe {
namespace {

/// What a team has seen of the episodes of a block, and what it does next.
class TeamWindow {
public:
  explicit TeamWindow(std::shared_ptr<const WindowPolicy> policy)
      : policy_(std::move(policy)) {}

  void start(const Block& block) {
    window_.setZero(index(block.lanes), index(policy_->shape.inputs()));
    step_.reset();
  }

  /// [lanes, two numbers a predator]. Whoever asks first in a step has it computed for all.
  const Matrix<float>& actions(const Layout& layout, const Block& block, std::size_t step) {
    if (step_ == step) return actions_;
    step_ = step;
    observe(layout, block);
    tape_.prepare(policy_->shape, window_);
    forward(policy_->shape, policy_->parameters.data(), tape_);
    squash(Squash::tanh, tape_.output(), actions_);
    return actions_;
  }

private:
  /// Moves the window on by a step.
  void observe(const Layout& layout, const Block& block) {
    const std::size_t inputs = policy_->shape.inputs();
    const std::size_t width = inputs / policy_->context;
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      float* row = window_.data() + lane * inputs;
      std::copy(row + width, row + inputs, row);
      float* now = row + inputs - width;
      for (std::size_t k = 0; k < width; ++k) now[k] = static_cast<float>(block.observations[k * block_lanes + lane]);
      for (std::size_t predator = 0; predator < policy_->scale.predators(); ++predator) {
        const std::size_t size = layout.scenario().observation_size(predator);
        policy_->scale.apply(predator, std::span(now + layout.observation_begin(predator), size));
      }
    }
  }

  std::shared_ptr<const WindowPolicy> policy_;
  Matrix<float> window_;
  std::optional<std::size_t> step_;  // the last one that was observed
  MlpTape<float> tape_;
  Matrix<float> actions_;
};

class WindowPlayer final : public Player {
public:
  explicit WindowPlayer(std::shared_ptr<TeamWindow> team)
      : team_(std::move(team)) {}

  void start(const Layout&, const Block& block, std::size_t, const Moment&) override { team_->start(block); }

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    const auto& actions = team_->actions(layout, block, moment.step);
    const auto [x, y] = action_rows(block, agent);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      x[lane] = static_cast<double>(actions(index(lane), index(2 * agent)));
      y[lane] = static_cast<double>(actions(index(lane), index(2 * agent + 1)));
    }
  }

private:
  std::shared_ptr<TeamWindow> team_;
};

std::size_t taken_context(PolicyReader& reader) {
  const std::string word = reader.take_word("context");
  std::size_t context = 0;
  const char* end = word.data() + word.size();
  if (const auto [stop, error] = std::from_chars(word.data(), end, context);
      error != std::errc() || stop != end || context == 0)
    reader.refuse(fmt::format("context '{}': expected a whole number of steps, at least 1", excerpt(word)));
  return context;
}

Scenario taken_scenario(PolicyReader& reader) {
  try {
    return Scenario::named(reader.take_word("scenario"));
  } catch (const UsageError& error) {
    reader.refuse(error.what());
  }
}

}  // namespace

std::size_t team_observation_size(const Scenario& scenario) {
  std::size_t size = 0;
  for (std::size_t predator = 0; predator < scenario.predators(); ++predator)
    size += scenario.observation_size(predator);
  return size;
}

std::string window_policy_bytes(const WindowPolicy& policy) {
  auto metadata = policy.notes;
  metadata["format"] = window_policy_format;
  metadata["scenario"] = policy.scenario;
  metadata["context"] = fmt::to_string(policy.context);
  PolicyWriter writer;
  writer.add("scale.mean", {policy.scale.mean.size()}, policy.scale.mean);
  writer.add("scale.deviation", {policy.scale.deviation.size()}, policy.scale.deviation);
  writer.add("", policy.shape, policy.parameters);
  std::string bytes = writer.bytes(metadata);
  try {
    parse_window_policy(bytes, "policy");
  } catch (const InputFileError& error) {
    throw UsageError(fmt::format("a policy that could not be read again: {}", error.what()));
  }
  return bytes;
}

WindowPolicy parse_window_policy(std::string_view bytes, const std::string& source) {
  PolicyReader reader(bytes, source);
  if (const auto format = reader.take_word("format"); format != window_policy_format)
    reader.refuse(fmt::format("format '{}': expected {}", excerpt(format), window_policy_format));
  const Scenario scenario = taken_scenario(reader);
  WindowPolicy policy;
  policy.scenario = scenario.name;
  policy.context = taken_context(reader);
  const std::size_t predators = scenario.predators();
  policy.scale.mean = reader.take("scale.mean", {predators});
  policy.scale.deviation = reader.take("scale.deviation", {predators});
  for (const float deviation : policy.scale.deviation)
    if (!(deviation > 0)) reader.refuse("tensor 'scale.deviation' holds a number that is not above 0");
  auto [shape, parameters] = take_stored_network(reader, "");
  const std::size_t observed = team_observation_size(scenario);
  if (shape.inputs() % observed != 0 || shape.inputs() / observed != policy.context)
    reader.refuse(fmt::format("a network of {} inputs: expected {} steps of the {} numbers that {}'s predators observe",
                              shape.inputs(), policy.context, observed, scenario.name));
  if (shape.outputs() != 2 * predators)
    reader.refuse(fmt::format("a network of {} outputs: expected {}, two a predator", shape.outputs(), 2 * predators));
  policy.shape = std::move(shape);
  policy.parameters = std::move(parameters);
  policy.notes = reader.metadata();
  reader.require_nothing_left();
  return policy;
}

Controller window_controller(std::string name, WindowPolicy policy, const Scenario& scenario) {
  if (policy.scenario != scenario.name)
    throw UsageError(
        fmt::format("{}: a policy for {}, not for {}", excerpt(name, 1000), policy.scenario, scenario.name));
  const auto shared = std::make_shared<const WindowPolicy>(std::move(policy));
  return {name, [name, shared](const Layout& layout, Side side) {
            if (side != Side::predators)
              throw UsageError(fmt::format("{}: a policy of the predators, not of the prey", excerpt(name, 1000)));
            if (shared->shape.inputs() != shared->context * team_observation_size(layout.scenario()))
              throw UsageError(fmt::format("{}: a policy for other observations than {} has", excerpt(name, 1000),
                                           layout.scenario().name));
            const auto window = std::make_shared<TeamWindow>(shared);
            Team team;
            for (std::size_t agent = 0; agent < agents_of(layout, side).size(); ++agent)
              team.push_back(std::make_unique<WindowPlayer>(window));
            return team;
          }};
}

}  // namespace folk::mpe
