// The self-confirming transformer: policies out of files, what they believe, and their training.

#include <folk/python/bindings/array.h>
#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>

#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/sct/policy/policy_file.h>
#include <folk/sct/policy/sct_player.h>
#include <folk/tools/choices/policy_names.h>
#include <folk/tools/program/threads_option.h>
#include <folk/tools/sct_train/begun_run.h>
#include <folk/tools/sct_train/evaluation_csv.h>

#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace folk::python {
namespace {

/// A policy that is ready to play.
struct HeldPolicy {
  std::string name;
  std::shared_ptr<const sct::Mind> mind;
};

/// "sct" and its like, or a file.
HeldPolicy loaded_policy(const std::string& name) {
  const auto shipped = tools::policy_file(name);
  const py::gil_scoped_release released;
  return {shipped ? name : "sct:" + name, tools::read_mind(shipped.value_or(name))};
}

py::dict architecture_of(const HeldPolicy& policy) {
  const auto& architecture = policy.mind->policy.architecture;
  py::dict sizes;
  sizes["hidden"] = architecture.hidden;
  sizes["layers"] = architecture.layers;
  sizes["heads"] = architecture.heads;
  sizes["context"] = architecture.context;
  sizes["time_rows"] = architecture.time_rows;
  return sizes;
}

py::dict training_of(const HeldPolicy& policy) {
  const auto& training = policy.mind->policy.training;
  py::dict record;
  record["mode"] = std::string(to_string(training.mode));
  record["data"] = training.data;
  record["roster"] = training.roster;
  record["payoffs"] = to_text(training.payoffs);
  record["rounds"] = training.rounds;
  record["return_target"] = training.return_target;
  record["seed"] = training.seed;
  record["steps"] = training.steps;
  record["final_belief_loss"] = training.final_belief_loss;
  record["final_action_loss"] = training.final_action_loss;
  return record;
}

Strategy policy_strategy(const HeldPolicy& policy, std::optional<double> target, bool sample, bool extrapolate) {
  sct::PlayOptions options;
  options.target = target;
  options.sample = sample;
  options.extrapolate = extrapolate;
  return sct::transformer(policy.name, policy.mind, options);
}

/// What it thinks before each round of a match that is given, and before the one that follows.
struct Thoughts {
  std::string moves;
  std::vector<double> beliefs;
};

Thoughts thoughts_in(const HeldPolicy& policy, const std::vector<Outcome>& history) {
  const auto& training = policy.mind->policy.training;
  const auto player = sct::transformer(policy.name, policy.mind).new_player();
  player->start({training.payoffs, Criterion::parse(training.criterion), {}});
  Thoughts thoughts;
  for (std::size_t round = 0; round <= history.size() && round < training.rounds; ++round) {
    thoughts.moves += to_char(player->move());
    thoughts.beliefs.push_back(player->belief().value_or(0.5));
    if (round < history.size()) player->observe(history[round].own, history[round].theirs);
  }
  return thoughts;
}

std::vector<Outcome> history_from(const std::string& own, const std::string& theirs) {
  if (own.size() != theirs.size()) throw UsageError("a history is two texts of C and D of one length");
  std::vector<Outcome> history;
  for (std::size_t round = 0; round < own.size(); ++round)
    for (const char letter : {own[round], theirs[round]})
      if (letter != 'C' && letter != 'D') throw UsageError("a history is two texts of C and D of one length");
  for (std::size_t round = 0; round < own.size(); ++round)
    history.push_back({move_from_bit(own[round] == 'D' ? 1 : 0), move_from_bit(theirs[round] == 'D' ? 1 : 0)});
  return history;
}

py::tuple thoughts(const HeldPolicy& policy, const std::string& own, const std::string& theirs) {
  if (!policy.mind->believes()) throw UsageError(policy.name + " was trained without beliefs");
  const auto history = history_from(own, theirs);
  Thoughts found;
  {
    const py::gil_scoped_release released;
    found = thoughts_in(policy, history);
  }
  std::vector<std::uint8_t> tokens;
  for (const double belief : found.beliefs) tokens.push_back(static_cast<std::uint8_t>(bit(likelier_move(belief))));
  return py::make_tuple(found.moves, array_of(std::move(found.beliefs)), array_of(std::move(tokens)));
}

/// `log` is told each evaluation, as the columns and the row of sct-train --log.
void train(const py::dict& options, const std::string& output, const py::object& log, const py::object& progress) {
  const Call call(options, {});
  const auto& values = call.values();
  auto config = tools::train_config(values, tools::text_option(values, "config"));
  config = tools::with_seed(config, config.training.seed);
  const unsigned threads = tools::threads_option(values, call.common());
  LongCall("training", progress).run([&](const Progress& told) {
    auto begun = tools::begin_run(config, threads, call.common());
    auto& run = begun.run;
    for (;;) {
      told.check();
      if (run.evaluation_due()) {
        run.evaluate();
        if (!log.is_none()) {
          const py::gil_scoped_acquire acquired;
          log(tools::evaluation_heading(config.holds_out()),
              tools::evaluation_row(run.history().back(), run.kept() + 1 == run.history().size()));
        }
      }
      if (run.finished()) break;
      run.step();
      told(static_cast<double>(run.steps()) / static_cast<double>(begun.plan.steps));
    }
    sct::write_policy(output, tools::finished_policy(begun, config));
  });
}

}  // namespace

void add_sct(py::module_& module) {
  py::class_<HeldPolicy>(module, "HeldPolicy", "A trained transformer; folk.sct.Policy shows it.")
      .def_readonly("name", &HeldPolicy::name, "As programs call it.")
      .def_property_readonly("architecture", architecture_of, "Sizes of the network.")
      .def_property_readonly("training", training_of, "How it was trained.")
      .def_property_readonly(
          "parameters",
          [](const HeldPolicy& policy) {
            const auto& parameters = policy.mind->policy.parameters;
            return view_of(std::span<const float>(parameters), {static_cast<py::ssize_t>(parameters.size())},
                           policy.mind);
          },
          "A view of all parameters, float32.")
      .def("strategy", policy_strategy, "It as a strategy.", py::arg("target"), py::arg("sample"),
           py::arg("extrapolate"))
      .def("thoughts", thoughts, "Moves, beliefs and belief tokens along a history.", py::arg("own"),
           py::arg("theirs"));
  module.def("load_policy", loaded_policy, "The policy of a name or a file.", py::arg("name"));
  module.def("train", train, "Trains as the options of sct-train say.", py::arg("options"), py::arg("output"),
             py::arg("log"), py::arg("progress"));
}

}  // namespace folk::python
