#include <folk/sct/network/layer_norm.h>

#include <cmath>

namespace folk::sct {

template <class S>
void layer_norm(const Matrix<S>& x, const S* gain, const S* bias, LayerNormTape<S>& tape, Matrix<S>& y) {
  const Index rows = x.rows();
  const Index h = x.cols();
  tape.normal.resize(rows, h);
  tape.inverse.resize(static_cast<std::size_t>(rows));
  y.resize(rows, h);
  const Eigen::Map<const RowVector<S>> g(gain, h);
  const Eigen::Map<const RowVector<S>> b(bias, h);
  RowVector<S> row(h);  // aligned: the last bits of Eigen's sums depend on where in memory they begin
  for (Index r = 0; r < rows; ++r) {
    row = x.row(r);
    row.array() -= row.mean();
    const S inverse = S(1) / std::sqrt(row.squaredNorm() / static_cast<S>(h) + S(1e-5));
    tape.inverse[static_cast<std::size_t>(r)] = inverse;
    row *= inverse;
    tape.normal.row(r) = row;
    y.row(r) = row.cwiseProduct(g) + b;
  }
}

template <class S>
void layer_norm_backward(const Matrix<S>& dy, const S* gain, const LayerNormTape<S>& tape, S* d_gain, S* d_bias,
                         Matrix<S>& dx) {
  const Index h = dy.cols();
  const Eigen::Map<const RowVector<S>> g(gain, h);
  Eigen::Map<RowVector<S>> dg(d_gain, h);
  Eigen::Map<RowVector<S>> db(d_bias, h);
  RowVector<S> d_normal(h);
  for (Index r = 0; r < dy.rows(); ++r) {
    const auto normal = tape.normal.row(r);
    dg += dy.row(r).cwiseProduct(normal);
    db += dy.row(r);
    d_normal = dy.row(r).cwiseProduct(g);
    const S mean = d_normal.mean();
    const S along = d_normal.dot(normal) / static_cast<S>(h);
    dx.row(r).array() += tape.inverse[static_cast<std::size_t>(r)] * (d_normal.array() - mean - normal.array() * along);
  }
}

template void layer_norm(const Matrix<float>&, const float*, const float*, LayerNormTape<float>&, Matrix<float>&);
template void layer_norm(const Matrix<double>&, const double*, const double*, LayerNormTape<double>&, Matrix<double>&);
template void layer_norm_backward(const Matrix<float>&, const float*, const LayerNormTape<float>&, float*, float*,
                                  Matrix<float>&);
template void layer_norm_backward(const Matrix<double>&, const double*, const LayerNormTape<double>&, double*, double*,
                                  Matrix<double>&);

}  // namespace folk::sct
