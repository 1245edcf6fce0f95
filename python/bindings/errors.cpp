// Folk's exceptions, one Python class each, with their messages.

#include <folk/python/bindings/messages.h>
#include <folk/python/bindings/parts.h>

#include <folk/analysis/pictures/render.h>
#include <folk/games/error.h>
#include <folk/games/progress.h>
#include <folk/strategies/machine.h>

#include <exception>

namespace folk::python {
namespace {

/// From now on what is thrown as Exception is raised as a class of this name. What is added later is tried first: bases
/// before what is derived from them.
template <class Exception>
py::object add(py::module_& module, const char* name, const py::object& base, const char* says) {
  static PyObject* type = nullptr;  // for as long as the interpreter lives
  type = py::exception<Exception>(module, name, base).release().ptr();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Exception& error) {
      PyErr_SetString(type, in_python(error.what()).c_str());
    }
  });
  const auto added = py::reinterpret_borrow<py::object>(type);
  added.doc() = says;
  return added;
}

}  // namespace

void add_errors(py::module_& module) {
  const py::object error =
      add<Error>(module, "Error", py::reinterpret_borrow<py::object>(PyExc_Exception),
                 "Base of everything that Folk raises on purpose; str(error) is one line that says what to do.");
  add<UsageError>(module, "UsageError", error,
                  "A name, a number or an argument that cannot be accepted (exit code 2 of the programs).");
  add<InputFileError>(module, "InputError", error, "A file that cannot be read or makes no sense (exit code 3).");
  const py::object environment = add<EnvironmentError>(
      module, "EnvironmentError", error,
      "The world outside failed: a player that broke its rules, an output that cannot be written (4).");
  add<UndecidedError>(module, "UndecidedError", error,
                      "A question that the way in which it is computed cannot decide (4).");
  add<RendererMissing>(module, "RendererMissing", environment,
                       "The program that draws (gnuplot, or Graphviz's dot) is not installed.");
  add<Cancelled>(module, "Cancelled", error, "Work was told to stop.");
}

}  // namespace folk::python
