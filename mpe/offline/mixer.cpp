#include <folk/mpe/offline/mixer.h>

#include <cmath>

namespace folk::mpe {
namespace {

constexpr Index width = index(MixerShape::width);
constexpr double least_share = 1e-10;

}  // namespace

template <class S>
void mixing_weights(const MixerShape& shape, const S* parameters, MixerTape<S>& tape) {
  forward(shape.layer(), parameters, tape.layer);
  const Matrix<S>& layer = tape.layer.output();
  const Index values = index(shape.values());
  tape.weights.resize(layer.rows(), values);
  tape.totals.resize(layer.rows(), 1);
  for (Index r = 0; r < layer.rows(); ++r) {
    const S* own = layer.data() + r * layer.cols();
    const S* common = own + values * width;
    S total = 0;
    for (Index i = 0; i < values; ++i, own += width) {
      S share = static_cast<S>(least_share);
      for (Index k = 0; k < width; ++k) share += std::abs(own[k]) * std::abs(common[k]);
      tape.weights(r, i) = share;
      total += share;
    }
    tape.totals(r, 0) = total;
    for (Index i = 0; i < values; ++i) tape.weights(r, i) /= total;
  }
}

template <class S>
void mix(const MixerTape<S>& tape, const Matrix<S>& values, Matrix<S>& mixed) {
  mixed.resize(values.rows(), 1);
  for (Index r = 0; r < values.rows(); ++r) {
    S sum = 0;
    for (Index i = 0; i < values.cols(); ++i) sum += tape.weights(r, i) * values(r, i);
    mixed(r, 0) = sum;
  }
}

template <class S>
void mixer_backward(const MixerShape& shape, const S* parameters, MixerTape<S>& tape, const Matrix<S>& values,
                    const Matrix<S>& mixed, const Matrix<S>& mixed_gradient, S* gradient) {
  const Matrix<S>& layer = tape.layer.output();
  Matrix<S>& out = tape.layer_gradient;
  out.setZero(layer.rows(), layer.cols());
  for (Index r = 0; r < layer.rows(); ++r) {
    const S* own = layer.data() + r * layer.cols();
    const S* common = own + values.cols() * width;
    S* own_out = out.data() + r * layer.cols();
    S* common_out = own_out + values.cols() * width;
    for (Index i = 0; i < values.cols(); ++i, own += width, own_out += width) {
      const S share = mixed_gradient(r, 0) * (values(r, i) - mixed(r, 0)) / tape.totals(r, 0);
      for (Index k = 0; k < width; ++k) {
        own_out[k] = share * std::copysign(std::abs(common[k]), own[k]);
        common_out[k] += share * std::copysign(std::abs(own[k]), common[k]);
      }
    }
  }
  backward<S>(shape.layer(), parameters, tape.layer, out, gradient, nullptr);
}

template void mixing_weights(const MixerShape&, const float*, MixerTape<float>&);
template void mixing_weights(const MixerShape&, const double*, MixerTape<double>&);
template void mix(const MixerTape<float>&, const Matrix<float>&, Matrix<float>&);
template void mix(const MixerTape<double>&, const Matrix<double>&, Matrix<double>&);
template void mixer_backward(const MixerShape&, const float*, MixerTape<float>&, const Matrix<float>&,
                             const Matrix<float>&, const Matrix<float>&, float*);
template void mixer_backward(const MixerShape&, const double*, MixerTape<double>&, const Matrix<double>&,
                             const Matrix<double>&, const Matrix<double>&, double*);

}  // namespace folk::mpe
