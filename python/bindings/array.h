#pragma once
// Numbers of the library as numpy arrays.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace folk::python {

namespace py = pybind11;

using Shape = std::vector<py::ssize_t>;

/// An array of numbers that `owner` keeps, row after row; it keeps the owner.
template <class Number, class Owner>
py::array_t<Number> array_over(std::span<const Number> numbers, Shape shape, std::shared_ptr<Owner> owner) {
  const py::capsule base(new std::shared_ptr<Owner>(std::move(owner)),
                         [](void* kept) { delete static_cast<std::shared_ptr<Owner>*>(kept); });
  return py::array_t<Number>(std::move(shape), numbers.data(), base);
}

/// The same, read-only: a view of what the library holds.
template <class Number, class Owner>
py::array_t<Number> view_of(std::span<const Number> numbers, Shape shape, std::shared_ptr<Owner> owner) {
  auto array = array_over(numbers, std::move(shape), std::move(owner));
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// An array that takes over the numbers of a vector.
template <class Number>
py::array_t<Number> array_of(std::vector<Number> numbers, Shape shape) {
  auto owner = std::make_shared<std::vector<Number>>(std::move(numbers));
  const std::span<const Number> span(*owner);
  return array_over(span, std::move(shape), std::move(owner));
}

template <class Number>
py::array_t<Number> array_of(std::vector<Number> numbers) {
  const auto size = static_cast<py::ssize_t>(numbers.size());
  return array_of(std::move(numbers), Shape{size});
}

}  // namespace folk::python
