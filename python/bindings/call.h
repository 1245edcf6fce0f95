#pragma once
// The arguments of a Python call as the options of a program, so that they mean, and are refused as, the same.

#include <folk/strategies/strategy.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/program.h>

#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <string>

namespace folk::python {

namespace py = pybind11;

/// Options by their names, and strategies that exist as objects alone: a SPEC calls them "python:NAME".
class Call {
public:
  /// `options` maps names to texts, to tuples of them, to True for an option without a value, or to a
  /// StageGame; `guests` maps names to
  /// Strategy objects.
  Call(const py::dict& options, const py::dict& guests);

  const tools::po::variables_map& values() const { return values_; }
  /// Nothing is said on stderr.
  const tools::Common& common() const { return common_; }

private:
  tools::po::variables_map values_;
  tools::Common common_;
  tools::MoreNames guests_;
};

}  // namespace folk::python
