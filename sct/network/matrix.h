#pragma once
// The matrices of the network: row-major, a token a row.

#include <folk/sct/network/architecture.h>

#include <Eigen/Core>

namespace folk::sct {

template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
template <class S>
using RowVector = Eigen::Matrix<S, 1, Eigen::Dynamic>;

using Index = Eigen::Index;

constexpr Index index(std::size_t i) { return static_cast<Index>(i); }

/// A tensor of a flat parameter (or gradient) buffer as a matrix or as a row.
template <class S>
auto as_matrix(const S* buffer, const Tensor& tensor) {
  return Eigen::Map<const Matrix<S>>(buffer + tensor.offset, index(tensor.rows()), index(tensor.columns()));
}
template <class S>
auto as_matrix(S* buffer, const Tensor& tensor) {
  return Eigen::Map<Matrix<S>>(buffer + tensor.offset, index(tensor.rows()), index(tensor.columns()));
}
template <class S>
auto as_row(const S* buffer, const Tensor& tensor) {
  return Eigen::Map<const RowVector<S>>(buffer + tensor.offset, index(tensor.size()));
}
template <class S>
auto as_row(S* buffer, const Tensor& tensor) {
  return Eigen::Map<RowVector<S>>(buffer + tensor.offset, index(tensor.size()));
}

/// sum += the rows of `matrix` added up, in their order.
template <class Row, class M>
void add_rows(Row&& sum, const M& matrix) {
  for (Index r = 0; r < matrix.rows(); ++r) sum += matrix.row(r);
}

}  // namespace folk::sct
