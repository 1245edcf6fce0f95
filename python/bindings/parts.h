#pragma once
// The parts of the module folk._folk, a source each: every one adds its types and functions.

#include <pybind11/pybind11.h>

namespace folk::python {

namespace py = pybind11;

void add_errors(py::module_& module);
void add_games(py::module_& module);
void add_strategies(py::module_& module);
void add_players(py::module_& module);
void add_match(py::module_& module);
void add_tournament(py::module_& module);
void add_thresholds(py::module_& module);
void add_check(py::module_& module);
void add_replies(py::module_& module);
void add_region(py::module_& module);
void add_classes(py::module_& module);
void add_evolution(py::module_& module);
void add_sct(py::module_& module);
void add_mpe(py::module_& module);

}  // namespace folk::python
