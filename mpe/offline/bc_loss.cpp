#include <folk/mpe/offline/bc_loss.h>
#include <folk/sct/network/gemm.h>

#include <algorithm>
#include <cmath>

namespace folk::mpe {
namespace {

/// Columns of a window that are multiplied at once: in a window of 20 steps those of 4.
constexpr Index window_parts = 5;

template <class S>
auto weight(const MlpShape& shape, S* numbers, std::size_t layer) {
  using M = std::conditional_t<std::is_const_v<S>, const Matrix<std::remove_const_t<S>>, Matrix<S>>;
  return Eigen::Map<M>(numbers + shape.weight(layer), index(shape.widths()[layer + 1]), index(shape.widths()[layer]));
}

/// Columns [begin, end), in which the first `rows` examples have more than zeros.
struct WindowPart {
  Index begin;
  Index end;
  Index rows;
};

template <class S>
WindowPart window_part(const BcExamples<S>& examples, Index part) {
  const Index columns = examples.windows.cols();
  const Index end = (part + 1) * columns / window_parts;
  const auto& padding = examples.padding;
  const auto empty = std::partition_point(padding.begin(), padding.end(), [&](Index zeros) { return zeros < end; });
  return {part * columns / window_parts, end, empty - padding.begin()};
}

/// Units [begin, end) of the first layer.
struct Units {
  Index begin;
  Index count;
};

template <class Work>
void share_units(Workers& workers, Index units, const Work& work) {
  const Index parts = index(workers.threads());
  workers.run(workers.threads(), [&](std::size_t part, unsigned) {
    const Index begin = index(part) * units / parts;
    work(Units{begin, (index(part) + 1) * units / parts - begin});
  });
}

/// Some columns of windows * w^T.
template <class S, class W>
void window_product(const BcExamples<S>& examples, const W& w, Units units, Matrix<S>& sums) {
  auto out = sums.middleCols(units.begin, units.count);
  out.setZero();
  for (Index k = 0; k < window_parts; ++k) {
    const auto [begin, end, rows] = window_part(examples, k);
    sct::add_product(out, sct::operand(examples.windows.block(0, begin, rows, end - begin)),
                     sct::transposed(w.block(units.begin, begin, units.count, end - begin)));
  }
}

/// Some rows of above^T * windows.
template <class S, class W>
void window_gradient(const BcExamples<S>& examples, const Matrix<S>& above, Units units, W& out) {
  for (Index k = 0; k < window_parts; ++k) {
    const auto [begin, end, rows] = window_part(examples, k);
    sct::set_product(out.block(units.begin, begin, units.count, end - begin),
                     sct::transposed(above.block(0, units.begin, rows, units.count)),
                     sct::operand(examples.windows.block(0, begin, rows, end - begin)));
  }
}

/// values = ReLU(values + bias) * dropout.
template <class S>
void activate(Matrix<S>& values, const S* bias, const Matrix<S>& dropout) {
  const Index columns = values.cols();
  for (Index r = 0; r < values.rows(); ++r) {
    S* value = values.data() + r * columns;
    const S* factor = dropout.data() + r * columns;
    for (Index c = 0; c < columns; ++c) {
      const S sum = value[c] + bias[c];
      value[c] = sum > S(0) ? sum * factor[c] : S(0);
    }
  }
}

template <class S>
void forward(const MlpShape& shape, const S* parameters, const BcExamples<S>& examples, BcTape<S>& tape,
             Workers& workers) {
  tape.values.resize(shape.layers());
  for (std::size_t layer = 0; layer < shape.layers(); ++layer) {
    Matrix<S>& values = tape.values[layer];
    const auto w = weight(shape, parameters, layer);
    values.resize(examples.windows.rows(), w.rows());
    if (layer == 0)
      share_units(workers, w.rows(), [&](Units units) { window_product(examples, w, units, values); });
    else
      sct::set_product(values, sct::operand(tape.values[layer - 1]), sct::transposed(w));
    const S* bias = parameters + shape.bias(layer);
    if (layer + 1 < shape.layers()) {
      activate(values, bias, examples.dropout[layer]);
      continue;
    }
    for (Index r = 0; r < values.rows(); ++r)
      for (Index c = 0; c < values.cols(); ++c) values(r, c) = std::tanh(values(r, c) + bias[c]);
  }
}

/// The loss; `gradient` is with respect to the sums that tanh is taken of.
template <class S>
double squared_error(const Matrix<S>& said, const Matrix<S>& wanted, Matrix<S>& gradient) {
  gradient.resize(said.rows(), said.cols());
  const double count = static_cast<double>(said.size());
  const S scale = static_cast<S>(2 / count);
  double sum = 0;
  for (Index i = 0; i < said.size(); ++i) {
    const S y = said.data()[i];
    const S error = y - wanted.data()[i];
    sum += static_cast<double>(error) * static_cast<double>(error);
    gradient.data()[i] = scale * error * (1 - y * y);
  }
  return sum / count;
}

template <class S>
void backward(const MlpShape& shape, const S* parameters, const BcExamples<S>& examples, BcTape<S>& tape, S* gradient,
              Workers& workers) {
  for (std::size_t layer = shape.layers(); layer-- > 0;) {
    const Matrix<S>& above = tape.gradients[layer];
    Eigen::Map<sct::RowVector<S>> bias(gradient + shape.bias(layer), above.cols());
    bias.setZero();
    sct::add_rows(bias, above);
    auto out = weight(shape, gradient, layer);
    if (layer == 0) {
      share_units(workers, out.rows(), [&](Units units) { window_gradient(examples, above, units, out); });
      return;
    }
    const Matrix<S>& values = tape.values[layer - 1];
    sct::set_product(out, sct::transposed(above), sct::operand(values));
    Matrix<S>& below = tape.gradients[layer - 1];
    below.resize(values.rows(), values.cols());
    sct::set_product(below, sct::operand(above), sct::operand(weight(shape, parameters, layer)));
    const S* factor = examples.dropout[layer - 1].data();
    for (Index i = 0; i < below.size(); ++i)
      below.data()[i] = values.data()[i] > S(0) ? below.data()[i] * factor[i] : S(0);
  }
}

}  // namespace

template <class S>
double bc_loss(const MlpShape& shape, const S* parameters, const BcExamples<S>& examples, BcTape<S>& tape, S* gradient,
               Workers& workers) {
  forward(shape, parameters, examples, tape, workers);
  tape.gradients.resize(shape.layers());
  const double loss = squared_error(tape.values.back(), examples.actions, tape.gradients.back());
  backward(shape, parameters, examples, tape, gradient, workers);
  return loss;
}

template double bc_loss(const MlpShape&, const float*, const BcExamples<float>&, BcTape<float>&, float*, Workers&);
template double bc_loss(const MlpShape&, const double*, const BcExamples<double>&, BcTape<double>&, double*, Workers&);

}  // namespace folk::mpe
