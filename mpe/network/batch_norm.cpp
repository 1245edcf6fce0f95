#include <folk/mpe/network/batch_norm.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk::mpe {
namespace {

/// Sums over the rows, in double whatever the numbers are: a batch has thousands.
template <class S, class Term>
std::vector<double> column_sums(const Matrix<S>& matrix, const Term& term) {
  std::vector<double> sums(static_cast<std::size_t>(matrix.cols()), 0.0);
  double* sum = sums.data();
  for (Index r = 0; r < matrix.rows(); ++r) {
    const S* row = matrix.data() + r * matrix.cols();
    for (Index c = 0; c < matrix.cols(); ++c) sum[c] += term(r, c, static_cast<double>(row[c]));
  }
  return sums;
}

}  // namespace

template <class S>
void batch_norm(const Matrix<S>& x, const S* weight, const S* bias, BatchNormTape<S>& tape, Matrix<S>& y) {
  const double rows = static_cast<double>(x.rows());
  tape.mean = column_sums(x, [](Index, Index, double value) { return value; });
  for (double& mean : tape.mean) mean /= rows;
  const double* centre = tape.mean.data();
  tape.variance = column_sums(x, [=](Index, Index c, double value) {
    const double distance = value - centre[c];
    return distance * distance;
  });
  tape.inverse.resize(tape.variance.size());
  std::vector<S> mean(tape.mean.size());
  for (std::size_t c = 0; c < mean.size(); ++c) {
    tape.variance[c] /= rows;
    tape.inverse[c] = static_cast<S>(1 / std::sqrt(tape.variance[c] + batch_norm_epsilon));
    mean[c] = static_cast<S>(tape.mean[c]);
  }
  tape.normal.resize(x.rows(), x.cols());
  y.resize(x.rows(), x.cols());
  const S* inverse = tape.inverse.data();
  for (Index r = 0; r < x.rows(); ++r) {
    const S* from = x.data() + r * x.cols();
    S* normal = tape.normal.data() + r * x.cols();
    S* to = y.data() + r * x.cols();
    for (Index c = 0; c < x.cols(); ++c) {
      normal[c] = (from[c] - mean[static_cast<std::size_t>(c)]) * inverse[c];
      to[c] = normal[c] * weight[c] + bias[c];
    }
  }
}

template <class S>
void batch_norm_backward(const Matrix<S>& dy, const BatchNormTape<S>& tape, S* d_weight, S* d_bias) {
  const S* normal = tape.normal.data();
  const Index inputs = dy.cols();
  const auto along =
      column_sums(dy, [=](Index r, Index c, double d) { return d * static_cast<double>(normal[r * inputs + c]); });
  const auto sum = column_sums(dy, [](Index, Index, double d) { return d; });
  for (std::size_t c = 0; c < sum.size(); ++c) {
    d_weight[c] += static_cast<S>(along[c]);
    d_bias[c] += static_cast<S>(sum[c]);
  }
}

template <class S>
void batch_norm_input_backward(const Matrix<S>& dy, const S* weight, const BatchNormTape<S>& tape, InputColumns columns,
                               Matrix<S>& dx) {
  const Index inputs = tape.normal.cols();
  const S* normal = tape.normal.data() + columns.first;
  const auto along =
      column_sums(dy, [=](Index r, Index c, double d) { return d * static_cast<double>(normal[r * inputs + c]); });
  const auto sum = column_sums(dy, [](Index, Index, double d) { return d; });
  const double rows = static_cast<double>(dy.rows());
  dx.resize(dy.rows(), dy.cols());
  for (Index c = 0; c < dy.cols(); ++c) {
    const auto k = static_cast<std::size_t>(c);
    const S mean = static_cast<S>(sum[k] / rows);
    const S slope = static_cast<S>(along[k] / rows);
    const S scale = weight[columns.first + c] * tape.inverse[static_cast<std::size_t>(columns.first + c)];
    for (Index r = 0; r < dy.rows(); ++r) dx(r, c) = scale * (dy(r, c) - mean - normal[r * inputs + c] * slope);
  }
}

template <class S>
void remember_batch(const BatchNormTape<S>& tape, std::vector<float>& mean, std::vector<float>& variance) {
  const double rows = static_cast<double>(tape.normal.rows());
  const auto move = [](float& remembered, double now) {
    remembered =
        static_cast<float>((1 - batch_norm_momentum) * static_cast<double>(remembered) + batch_norm_momentum * now);
  };
  for (std::size_t c = 0; c < mean.size(); ++c) {
    move(mean[c], tape.mean[c]);
    move(variance[c], tape.variance[c] * rows / (rows - 1));
  }
}

template <class S>
void normalise(const InputNormalisation& normalisation, Matrix<S>& x) {
  for (Index c = 0; c < x.cols(); ++c) {
    const auto k = static_cast<std::size_t>(c);
    const S mean = static_cast<S>(normalisation.mean[k]);
    const S deviation = std::sqrt(static_cast<S>(normalisation.variance[k]) + static_cast<S>(normalisation.epsilon));
    const S weight = static_cast<S>(normalisation.weight[k]);
    const S bias = static_cast<S>(normalisation.bias[k]);
    for (Index r = 0; r < x.rows(); ++r) x(r, c) = (x(r, c) - mean) / deviation * weight + bias;
  }
}

NormalisedShape::NormalisedShape(MlpShape network, std::size_t networks)
    : network_(std::move(network)),
      networks_(networks) {}

template <class S>
void forward(const NormalisedShape& shape, const S* parameters, NormalisedTape<S>& tape, std::size_t networks) {
  batch_norm(tape.input, parameters, parameters + shape.bias(), tape.norm, tape.normalised);
  tape.networks.resize(shape.networks());
  for (std::size_t k = 0; k < networks; ++k) {
    tape.networks[k].prepare(shape.network(), tape.normalised);
    forward(shape.network(), parameters + shape.network_begin(k), tape.networks[k]);
  }
}

template <class S>
void backward(const NormalisedShape& shape, const S* parameters, NormalisedTape<S>& tape,
              std::span<const Matrix<S>> output_gradients, S* gradient) {
  for (std::size_t k = 0; k < output_gradients.size(); ++k) {
    const std::size_t begin = shape.network_begin(k);
    Matrix<S>& below = k == 0 ? tape.input_gradient : tape.other_gradient;
    backward(shape.network(), parameters + begin, tape.networks[k], output_gradients[k], gradient + begin, &below,
             {0, index(shape.inputs())});
    if (k > 0) tape.input_gradient += tape.other_gradient;
  }
  batch_norm_backward(tape.input_gradient, tape.norm, gradient, gradient + shape.bias());
}

template <class S>
void input_backward(const NormalisedShape& shape, const S* parameters, NormalisedTape<S>& tape,
                    const Matrix<S>& output_gradient, InputColumns columns, Matrix<S>& input_gradient) {
  backward<S>(shape.network(), parameters + shape.network_begin(0), tape.networks[0], output_gradient, nullptr,
              &tape.input_gradient, columns);
  batch_norm_input_backward(tape.input_gradient, parameters, tape.norm, columns, input_gradient);
}

std::vector<float> initial_parameters(const NormalisedShape& shape, std::uint64_t seed, std::uint64_t first,
                                      double last) {
  std::vector<float> parameters(shape.network_begin(0), 0.0F);
  std::fill_n(parameters.begin(), shape.inputs(), 1.0F);
  const MlpShape& network = shape.network();
  const std::size_t layer = network.layers() - 1;
  for (std::size_t k = 0; k < shape.networks(); ++k) {
    auto numbers = initial_parameters(network, seed, first + k);
    const auto small = initial_parameters(network, seed, first + k, last);
    std::copy(small.begin() + static_cast<std::ptrdiff_t>(network.weight(layer)),
              small.begin() + static_cast<std::ptrdiff_t>(network.bias(layer)),
              numbers.begin() + static_cast<std::ptrdiff_t>(network.weight(layer)));
    parameters.insert(parameters.end(), numbers.begin(), numbers.end());
  }
  return parameters;
}

template void batch_norm(const Matrix<float>&, const float*, const float*, BatchNormTape<float>&, Matrix<float>&);
template void batch_norm_backward(const Matrix<float>&, const BatchNormTape<float>&, float*, float*);
template void batch_norm_input_backward(const Matrix<float>&, const float*, const BatchNormTape<float>&, InputColumns,
                                        Matrix<float>&);
template void remember_batch(const BatchNormTape<float>&, std::vector<float>&, std::vector<float>&);
template void normalise(const InputNormalisation&, Matrix<float>&);
template void forward(const NormalisedShape&, const float*, NormalisedTape<float>&, std::size_t);
template void backward(const NormalisedShape&, const float*, NormalisedTape<float>&, std::span<const Matrix<float>>,
                       float*);
template void input_backward(const NormalisedShape&, const float*, NormalisedTape<float>&, const Matrix<float>&,
                             InputColumns, Matrix<float>&);
template void batch_norm(const Matrix<double>&, const double*, const double*, BatchNormTape<double>&, Matrix<double>&);
template void batch_norm_backward(const Matrix<double>&, const BatchNormTape<double>&, double*, double*);
template void batch_norm_input_backward(const Matrix<double>&, const double*, const BatchNormTape<double>&,
                                        InputColumns, Matrix<double>&);
template void remember_batch(const BatchNormTape<double>&, std::vector<float>&, std::vector<float>&);
template void normalise(const InputNormalisation&, Matrix<double>&);
template void forward(const NormalisedShape&, const double*, NormalisedTape<double>&, std::size_t);
template void backward(const NormalisedShape&, const double*, NormalisedTape<double>&, std::span<const Matrix<double>>,
                       double*);
template void input_backward(const NormalisedShape&, const double*, NormalisedTape<double>&, const Matrix<double>&,
                             InputColumns, Matrix<double>&);

}  // namespace folk::mpe
