// Strategies by name and as machines: what is known of them, compared, drawn.

#include <folk/python/bindings/call.h>
#include <folk/python/bindings/parts.h>

#include <folk/analysis/pictures/automaton_picture.h>
#include <folk/games/error.h>
#include <folk/strategies/equivalence.h>
#include <folk/strategies/facts.h>
#include <folk/strategies/machine_text.h>
#include <folk/tools/choices/chosen_machine.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/ipd_strategies/difference.h>
#include <folk/tools/ipd_strategies/entry.h>
#include <folk/tools/strategy_graph/drawn.h>

#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace folk::python {
namespace {

Sense sense_of(bool any_own_moves) { return any_own_moves ? Sense::any_own_moves : Sense::own_moves_its_own; }

const Machine& machine_of(const Strategy& strategy, const char* done_to) {
  tools::require_machine(strategy, done_to);
  return *strategy.machine;
}

Strategy of_machine(std::string name, Automaton machine) {
  Strategy strategy;
  strategy.name = std::move(name);
  strategy.machine = std::make_shared<const Automaton>(std::move(machine));
  return strategy;
}

Automaton smallest(const Strategy& strategy, bool any_own_moves, const char* done_to) {
  const Sense sense = sense_of(any_own_moves);
  const py::gil_scoped_release released;
  const Machine& machine = machine_of(strategy, done_to);
  const auto table = machine.finite() ? tabulate(machine, sense) : std::nullopt;
  if (!table) throw UsageError(strategy.name + " has too many states, or infinitely many, to be " + done_to);
  return minimise(*table, sense);
}

/// The states of a machine in breadth-first order, (P(C), successors by outcome CC, CD, DC, DD).
std::vector<std::pair<double, std::array<std::uint32_t, 4>>> nodes(const Strategy& strategy, bool any_own_moves) {
  std::vector<std::pair<double, std::array<std::uint32_t, 4>>> found;
  const Automaton automaton = smallest(strategy, any_own_moves, "listed");
  for (const auto& node : automaton.nodes()) found.emplace_back(node.cooperation, node.next);
  return found;
}

std::string difference(const Strategy& first, const Strategy& second, bool any_own_moves, std::size_t most_pairs) {
  tools::Difference result{first.name, second.name, sense_of(any_own_moves), {}};
  {
    const py::gil_scoped_release released;
    result.found = tools::compared(machine_of(first, "compared"), machine_of(second, "compared"),
                                   first.name == second.name, result.sense, most_pairs);
  }
  auto json = tools::difference_json(result);
  json["text"] = tools::difference_text(result);
  return json.dump();
}

std::string facts(const Strategy& strategy) {
  const py::gil_scoped_release released;
  return tools::entry_json(tools::entries_of({strategy}).front()).dump();
}

std::string listed(const py::object& spec, const py::dict& options, const py::dict& guests) {
  const Call call(options, guests);
  const auto payoffs = tools::chosen_game(call.values()).payoffs;
  const Registry registry = tools::standard_names();
  const auto spec_text = spec.is_none() ? std::string() : spec.cast<std::string>();
  const py::gil_scoped_release released;
  if (spec_text.empty()) return tools::entries_json(tools::named_entries(registry), registry.groups()).dump();
  return tools::entries_json(tools::entries_of(registry.roster(spec_text, payoffs)), {}).dump();
}

std::vector<Strategy> roster(const std::string& spec, const py::dict& options, const py::dict& guests) {
  const Call call(options, guests);
  const py::gil_scoped_release released;
  return tools::standard_names().roster(spec, tools::chosen_game(call.values()).payoffs);
}

Strategy named(const std::string& name, const py::dict& options, const py::dict& guests) {
  const Call call(options, guests);
  const py::gil_scoped_release released;
  return tools::standard_names().make(name, tools::chosen_game(call.values()).payoffs);
}

/// "machine NAME ..." with its name, or the one-line form without.
Strategy read_machine(const std::string& text, const std::string& name) {
  if (text.find("machine") == std::string::npos) return of_machine(name, read_machine_line(text));
  auto machines = read_machines(text, "the text of the machine");
  if (machines.size() != 1)
    throw UsageError("the text has " + std::to_string(machines.size()) +
                     " machines: give one, or write a file and name it @FILE");
  return of_machine(machines.front().name, std::move(machines.front().machine));
}

void draw_strategy(const Strategy& strategy, const std::string& name, const std::string& path, bool any_own_moves,
                   unsigned horizon) {
  machine_of(strategy, "drawn");
  const auto extension = path.substr(path.rfind('.') + 1);
  const py::gil_scoped_release released;
  const auto [automaton, drawing] = tools::drawn(strategy, name, sense_of(any_own_moves), horizon, {});
  for (const auto format : {PictureFormat::svg, PictureFormat::png, PictureFormat::pdf})
    if (extension == to_string(format)) return draw_automaton(automaton, drawing, path, format);
  throw UsageError(path + ": the extension says the format: .svg, .png or .pdf");
}

std::string dot(const Strategy& strategy, const std::string& name, bool any_own_moves, unsigned horizon) {
  machine_of(strategy, "drawn");
  const py::gil_scoped_release released;
  const auto [automaton, drawing] = tools::drawn(strategy, name, sense_of(any_own_moves), horizon, {});
  return to_dot(automaton, drawing);
}

}  // namespace

void add_strategies(py::module_& module) {
  py::class_<Strategy>(module, "HeldStrategy", "A strategy of the library; folk.Strategy shows it.")
      .def_property_readonly(
          "name", [](const Strategy& strategy) { return strategy.name; }, "What it is called.")
      .def_property_readonly(
          "has_machine", [](const Strategy& strategy) { return strategy.machine != nullptr; },
          "False for an opaque player.")
      .def_property_readonly(
          "deterministic",
          [](const Strategy& strategy) {
            return strategy.machine ? strategy.machine->deterministic() : strategy.deterministic;
          },
          "False where it draws random numbers.")
      .def("facts", facts, "What can be computed of it, as JSON.")
      .def("nodes", nodes,
           "States (P(C), successors by CC, CD, DC, DD) of the smallest automaton, the first the start.",
           py::arg("any_own_moves"))
      .def(
          "minimised",
          [](const Strategy& strategy, bool any) {
            return of_machine(strategy.name, smallest(strategy, any, "minimised"));
          },
          "The smallest automaton as a strategy.", py::arg("any_own_moves"))
      .def(
          "text",
          [](const Strategy& strategy, bool any) {
            return write_machine(strategy.name, smallest(strategy, any, "written"));
          },
          "The smallest automaton as an @file holds it.", py::arg("any_own_moves"))
      .def("difference", difference, "What ipd-strategies diff finds, as JSON.", py::arg("other"),
           py::arg("any_own_moves"), py::arg("most_pairs"))
      .def("draw", draw_strategy, "The picture of strategy-graph, into a file.", py::arg("name"), py::arg("path"),
           py::arg("any_own_moves"), py::arg("horizon"))
      .def("dot", dot, "The picture in Graphviz's language.", py::arg("name"), py::arg("any_own_moves"),
           py::arg("horizon"));
  module.def("listed", listed, "What ipd-strategies list knows, as JSON.", py::arg("spec"), py::arg("options"),
             py::arg("guests"));
  module.def("roster", roster, "The strategies of a SPEC.", py::arg("spec"), py::arg("options"), py::arg("guests"));
  module.def("named", named, "The strategy of a name.", py::arg("name"), py::arg("options"), py::arg("guests"));
  module.def("read_machine", read_machine, "A machine out of its text.", py::arg("text"), py::arg("name"));
}

}  // namespace folk::python
