#pragma once
// What the programs write, as a string.

#include <pybind11/pybind11.h>

#include <ostream>
#include <sstream>
#include <string>
#include <utility>

namespace folk::python {

namespace py = pybind11;

/// `write(stream)` writes it, without the GIL.
template <class Write>
std::string written(Write&& write) {
  const py::gil_scoped_release released;
  std::ostringstream out;
  std::forward<Write>(write)(out);
  return std::move(out).str();
}

}  // namespace folk::python
