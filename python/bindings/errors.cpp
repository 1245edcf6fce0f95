// Folk's exceptions, one Python class each, with the messages as they are.

#include <folk/python/bindings/parts.h>

#include <folk/analysis/pictures/render.h>
#include <folk/games/error.h>
#include <folk/games/progress.h>
#include <folk/strategies/machine.h>

namespace folk::python {

void add_errors(py::module_& module) {
  auto error = py::register_exception<Error>(module, "Error", PyExc_Exception);
  error.doc() = "Base of everything that Folk raises on purpose; str(error) is one line that says what to do.";
  // What is registered later is tried first: bases before what is derived from them.
  const auto usage = py::register_exception<UsageError>(module, "UsageError", error);
  usage.doc() = "A name, a number or an option that cannot be accepted (exit code 2 of the programs).";
  const auto input = py::register_exception<InputFileError>(module, "InputError", error);
  input.doc() = "A file that cannot be read or makes no sense (exit code 3).";
  const auto environment = py::register_exception<EnvironmentError>(module, "EnvironmentError", error);
  environment.doc() = "The world outside failed: a player that broke its rules, an output that cannot be written (4).";
  const auto undecided = py::register_exception<UndecidedError>(module, "UndecidedError", error);
  undecided.doc() = "A question that the way in which it is computed cannot decide (4).";
  const auto missing = py::register_exception<RendererMissing>(module, "RendererMissing", environment);
  missing.doc() = "The program that draws (gnuplot, or Graphviz's dot) is not installed.";
  const auto cancelled = py::register_exception<Cancelled>(module, "Cancelled", error);
  cancelled.doc() = "Work was told to stop.";
}

}  // namespace folk::python
