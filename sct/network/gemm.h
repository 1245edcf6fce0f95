#pragma once
// Products of dense matrices at the shapes of a transformer: tall times small. Eigen's own reach about half of a
// processor's peak with AVX-512 in version 3.4; these are tiled by hand (Goto & van de Geijn 2008).

#include <folk/sct/network/matrix.h>

namespace folk::sct {

/// A row-major matrix or the transpose of one, anywhere in memory: element (r, c) stands at data[r * row_stride + c *
/// column_stride], and one of the strides is 1.
template <class S>
struct Operand {
  const S* data;
  Index rows;
  Index columns;
  Index row_stride;
  Index column_stride;
};

/// A row-major Eigen matrix, map or block of one as an operand.
template <class M>
auto operand(const M& matrix) {
  static_assert(M::IsRowMajor);
  return Operand<typename M::Scalar>{matrix.data(), matrix.rows(), matrix.cols(), matrix.outerStride(), 1};
}

/// Its transpose.
template <class M>
auto transposed(const M& matrix) {
  static_assert(M::IsRowMajor);
  return Operand<typename M::Scalar>{matrix.data(), matrix.cols(), matrix.rows(), 1, matrix.outerStride()};
}

/// c (row-major, of a.rows rows that are `c_stride` apart) = a * b, or += with `add`. Each element is summed in the
/// same order whatever the shapes of a and b.
template <class S>
void multiply(const Operand<S>& a, const Operand<S>& b, S* c, Index c_stride, bool add);

/// out = a * b and out += a * b, for a row-major matrix, map or block `out`.
template <class S, class M>
void set_product(M&& out, const Operand<S>& a, const Operand<S>& b) {
  multiply(a, b, out.data(), out.outerStride(), false);
}
template <class S, class M>
void add_product(M&& out, const Operand<S>& a, const Operand<S>& b) {
  multiply(a, b, out.data(), out.outerStride(), true);
}

}  // namespace folk::sct
