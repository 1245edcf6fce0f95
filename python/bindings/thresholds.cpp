// From which patience on: sets of discount factors with exact ends, which print and compare.

#include <folk/python/bindings/thresholds.h>

#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>

#include <folk/games/error.h>
#include <folk/tools/choices/chosen_machine.h>
#include <folk/tools/choices/game_option.h>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <array>
#include <string>
#include <vector>

namespace folk::python {
namespace {

using Ends = std::vector<std::pair<AlgebraicNumber, AlgebraicNumber>>;

Ends intervals(const DiscountSet& set) {
  Ends ends;
  for (const auto& interval : set.intervals()) ends.emplace_back(interval.low.at, interval.high.at);
  return ends;
}

Automaton threshold_table(const Strategy& strategy) {
  tools::require_machine(strategy, "asked for thresholds");
  auto table = strategy.machine->finite() ? tabulate(*strategy.machine, Sense::any_own_moves) : std::nullopt;
  if (!table)
    throw UsageError(strategy.name + " has too many states, or infinitely many: thresholds are of finite machines");
  return minimise(*table, Sense::any_own_moves);
}

py::dict asked_thresholds(const std::string& first, const std::string& second, const py::dict& options,
                          const py::dict& guests, const py::object& progress) {
  const Call call(options, guests);
  const Payoffs payoffs = tools::chosen_game(call.values()).payoffs;
  const Registry registry = tools::standard_names();
  const Strategy one = registry.make(first, payoffs);
  const Strategy two = registry.make(second, payoffs);
  return sets_of(LongCall("looking for thresholds", progress).run([&](const Progress& told) {
    return thresholds(threshold_table(one), threshold_table(two), payoffs, Sides::both, {}, told);
  }));
}

/// Another kind of number as one of these: a fraction by its text, so that nothing is rounded.
AlgebraicNumber number_of(const py::object& number) {
  if (py::isinstance<AlgebraicNumber>(number)) return number.cast<AlgebraicNumber>();
  return AlgebraicNumber(parse_rational(py::str(number).cast<std::string>()));
}

std::strong_ordering compared(const AlgebraicNumber& number, const py::object& other) {
  return number <=> number_of(other);
}

void add_number(py::module_& module) {
  py::class_<AlgebraicNumber>(module, "AlgebraicNumber",
                              "An exact number between 0 and 1: a fraction, or a root of a polynomial. It compares "
                              "with others, fractions, whole numbers and floats (taken as they print).")
      .def_property_readonly("is_rational", &AlgebraicNumber::is_rational, "False for an irrational root.")
      .def("__float__", &AlgebraicNumber::nearest)
      .def("__str__", [](const AlgebraicNumber& number) { return to_text(number); })
      .def("__repr__", [](const AlgebraicNumber& number) { return "<folk.AlgebraicNumber " + to_text(number) + ">"; })
      .def(
          "__eq__", [](const AlgebraicNumber& a, const py::object& b) { return compared(a, b) == 0; },
          py::is_operator())
      .def(
          "__lt__", [](const AlgebraicNumber& a, const py::object& b) { return compared(a, b) < 0; }, py::is_operator())
      .def(
          "__le__", [](const AlgebraicNumber& a, const py::object& b) { return compared(a, b) <= 0; },
          py::is_operator())
      .def(
          "__gt__", [](const AlgebraicNumber& a, const py::object& b) { return compared(a, b) > 0; }, py::is_operator())
      .def(
          "__ge__", [](const AlgebraicNumber& a, const py::object& b) { return compared(a, b) >= 0; },
          py::is_operator())
      .def("__hash__", [](const AlgebraicNumber& number) { return py::hash(py::float_(number.nearest())); });
}

}  // namespace

py::dict sets_of(const Thresholds& thresholds) {
  py::dict sets;
  const auto put = [&](const char* name, const std::optional<Threshold>& threshold) {
    sets[name] = threshold ? py::cast(threshold->set) : py::none();
  };
  put("nash", thresholds.nash);
  put("subgame_perfect", thresholds.subgame_perfect);
  put("self_confirming_unrestricted", thresholds.self_confirming_unrestricted);
  return sets;
}

void add_thresholds(py::module_& module) {
  add_number(module);
  py::class_<DiscountSet>(module, "DiscountSet",
                          "A set of discount factors in (0, 1): intervals with exact ends. str() is as the programs "
                          "print it; equal sets are equal; `0.6 in set` asks for one discount factor.")
      .def_property_readonly("intervals", intervals, "Pairs of exact ends, ascending; [a, 1] stands for [a, 1).")
      .def_property_readonly(
          "numbers", [](const DiscountSet& set) { return to_numbers(set); }, "The ends as the nearest floats.")
      .def_property_readonly(
          "texts", [](const DiscountSet& set) { return to_exact_texts(set); }, "The ends exactly, as texts.")
      .def_property_readonly("empty", &DiscountSet::empty, "True for never.")
      .def(
          "__contains__",
          [](const DiscountSet& set, const py::object& discount) {
            const Rational number = parse_rational(py::str(discount).cast<std::string>());
            return number > 0 && number < 1 && set.contains(number);
          },
          py::arg("discount"))
      .def(
          "__eq__", [](const DiscountSet& a, const DiscountSet& b) { return a == b; }, py::is_operator())
      .def("__bool__", [](const DiscountSet& set) { return !set.empty(); })
      .def("__str__", [](const DiscountSet& set) { return to_readable_text(set); })
      .def("__repr__", [](const DiscountSet& set) { return "<folk.DiscountSet " + to_readable_text(set) + ">"; });
  module.def("thresholds", asked_thresholds, "The sets of discount factors at which two machines are in equilibrium.",
             py::arg("first"), py::arg("second"), py::arg("options"), py::arg("guests"), py::arg("progress"));
}

}  // namespace folk::python
