#include <folk/sct/network/gemm.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk::sct {
namespace {

template <class S>
void expect_product(Index rows, Index depth, Index columns, bool add, double tolerance) {
  const Matrix<S> a = Matrix<S>::Random(rows, depth);
  const Matrix<S> b = Matrix<S>::Random(depth, columns);
  const Matrix<S> before = Matrix<S>::Random(rows, columns + 3);
  Matrix<S> expected = before;
  if (add)
    expected.leftCols(columns) += a * b;
  else
    expected.leftCols(columns) = a * b;
  const Matrix<S> a_turned = a.transpose();
  const Matrix<S> b_turned = b.transpose();
  for (const auto& left : {operand(a), transposed(a_turned)})
    for (const auto& right : {operand(b), transposed(b_turned)}) {
      Matrix<S> out = before;
      multiply(left, right, out.data(), out.outerStride(), add);
      ASSERT_LE((out - expected).cwiseAbs().maxCoeff(), tolerance)
          << rows << " x " << depth << " x " << columns << (add ? " added" : "");
    }
}

RC_GTEST_PROP(Gemm, IsEigensProductAtAnyShape, ()) {
  const auto rows = *rc::gen::inRange<Index>(1, 40);
  const auto depth = *rc::gen::inRange<Index>(0, 600);
  const auto columns = *rc::gen::inRange<Index>(1, 80);
  const auto add = *rc::gen::arbitrary<bool>();
  expect_product<double>(rows, depth, columns, add, 1e-12 * static_cast<double>(depth + 1));
  expect_product<float>(rows, depth, columns, add, 1e-5 * static_cast<double>(depth + 1));
}

TEST(Gemm, ARowIsTheSameWhateverRowsAreBesideIt) {
  const Matrix<float> a = Matrix<float>::Random(31, 512);
  const Matrix<float> b = Matrix<float>::Random(512, 65);
  Matrix<float> all(31, 65);
  set_product(all, operand(a), operand(b));
  for (Index r = 0; r < a.rows(); ++r) {
    Matrix<float> one(1, 65);
    set_product(one, operand(a.middleRows(r, 1)), operand(b));
    ASSERT_EQ(one, all.row(r)) << r;
  }
}

}  // namespace
}  // namespace folk::sct
