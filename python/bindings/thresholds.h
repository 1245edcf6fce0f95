#pragma once
// Sets of discount factors as Python objects.

#include <folk/analysis/thresholds/thresholds.h>

#include <pybind11/pybind11.h>

namespace folk::python {

namespace py = pybind11;

/// {"nash": DiscountSet, ...}; None for a notion that has none.
py::dict sets_of(const Thresholds& thresholds);

}  // namespace folk::python
