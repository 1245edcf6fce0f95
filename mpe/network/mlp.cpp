#include <folk/games/error.h>
#include <folk/mpe/network/mlp.h>
#include <folk/mpe/world/random_stream.h>
#include <folk/sct/network/gemm.h>

#include <cmath>
#include <cstring>
#include <utility>

namespace folk::mpe {
namespace {

template <class S>
auto weight(const MlpShape& shape, const S* parameters, std::size_t layer) {
  return Eigen::Map<const Matrix<S>>(parameters + shape.weight(layer), index(shape.widths()[layer + 1]),
                                     index(shape.widths()[layer]));
}

/// values += bias in each row, and at least 0 with `relu`.
template <class S>
void add_bias(Matrix<S>& values, const S* bias, bool relu) {
  const Index columns = values.cols();
  for (Index r = 0; r < values.rows(); ++r) {
    S* row = values.data() + r * columns;
    if (relu)
      for (Index c = 0; c < columns; ++c) {
        const S sum = row[c] + bias[c];
        row[c] = sum > S(0) ? sum : S(0);
      }
    else
      for (Index c = 0; c < columns; ++c) row[c] += bias[c];
  }
}

/// gradient = 0 where the unit was off.
template <class S>
void stop_at_zeros(Matrix<S>& gradient, const Matrix<S>& values) {
  S* g = gradient.data();
  const S* v = values.data();
  for (Index i = 0; i < gradient.size(); ++i) g[i] = v[i] > S(0) ? g[i] : S(0);
}

/// Products with so few columns would fill a small part of the tiles that gemm computes in.
constexpr Index narrow = 4;

template <class S, std::size_t bytes>
struct VectorOf {
  using type [[gnu::vector_size(bytes)]] = S;
};

/// The lanes of a vector added up by halves.
template <class S, std::size_t bytes>
S lanes_added(const typename VectorOf<S, bytes>::type& lanes) {
  if constexpr (bytes == 2 * sizeof(S)) {
    return lanes[0] + lanes[1];
  } else {
    using Half = typename VectorOf<S, bytes / 2>::type;
    Half low, high;
    std::memcpy(&low, &lanes, sizeof low);
    std::memcpy(&high, reinterpret_cast<const char*>(&lanes) + sizeof low, sizeof high);
    return lanes_added<S, bytes / 2>(low + high);
  }
}

/// out = a * b^T for a b of a few rows; each element is summed in the same order whatever stands beside it.
template <class S>
void narrow_product(const Matrix<S>& a, const S* b, Index columns, Matrix<S>& out) {
  using Lanes = typename VectorOf<S, 64>::type;
  constexpr Index lanes = 64 / static_cast<Index>(sizeof(S));
  const Index depth = a.cols();
  for (Index r = 0; r < a.rows(); ++r) {
    const S* row = a.data() + r * depth;
    for (Index c = 0; c < columns; ++c) {
      const S* factors = b + c * depth;
      Lanes sums = {};
      Index k = 0;
      for (; k + lanes <= depth; k += lanes) {
        Lanes x, y;
        std::memcpy(&x, row + k, sizeof x);
        std::memcpy(&y, factors + k, sizeof y);
        sums += x * y;
      }
      S sum = 0;
      for (; k < depth; ++k) sum += row[k] * factors[k];
      out(r, c) = sum + lanes_added<S, 64>(sums);
    }
  }
}

/// out = a * w^T.
template <class S, class W>
void layer_product(const Matrix<S>& a, const W& w, Matrix<S>& out) {
  if (w.rows() <= narrow)
    narrow_product(a, w.data(), w.rows(), out);
  else
    sct::set_product(out, sct::operand(a), sct::transposed(w));
}

/// out = some columns of above * w.
template <class S, class W>
void input_product(const Matrix<S>& above, const W& w, InputColumns columns, Matrix<S>& out) {
  out.resize(above.rows(), columns.count);
  if (columns.count <= narrow) {
    const Matrix<S> turned = w.middleCols(columns.first, columns.count).transpose();
    narrow_product(above, turned.data(), columns.count, out);
  } else {
    sct::set_product(out, sct::operand(above), sct::operand(w.middleCols(columns.first, columns.count)));
  }
}

}  // namespace

MlpShape::MlpShape(std::vector<std::size_t> widths)
    : widths_(std::move(widths)) {
  if (widths_.size() < 2) throw UsageError("a network of one layer: expected inputs, then outputs");
  std::size_t end = 0;
  for (std::size_t layer = 0; layer + 1 < widths_.size(); ++layer) {
    weights_.push_back(end);
    end += widths_[layer] * widths_[layer + 1];
    biases_.push_back(end);
    end += widths_[layer + 1];
  }
}

template <class S>
void MlpTape<S>::prepare(const MlpShape& shape, std::size_t rows) {
  shared_input = nullptr;
  prepare_layers(shape, rows);
  values[0].resize(index(rows), index(shape.inputs()));
}

template <class S>
void MlpTape<S>::prepare(const MlpShape& shape, const Matrix<S>& input) {
  shared_input = &input;
  prepare_layers(shape, static_cast<std::size_t>(input.rows()));
}

template <class S>
void MlpTape<S>::prepare_layers(const MlpShape& shape, std::size_t rows) {
  values.resize(shape.widths().size());
  for (std::size_t k = 1; k < values.size(); ++k) values[k].resize(index(rows), index(shape.widths()[k]));
}

template <class S>
void forward(const MlpShape& shape, const S* parameters, MlpTape<S>& tape) {
  for (std::size_t layer = 0; layer < shape.layers(); ++layer) {
    auto& values = tape.values[layer + 1];
    layer_product(tape.layer_input(layer), weight(shape, parameters, layer), values);
    add_bias(values, parameters + shape.bias(layer), layer + 1 < shape.layers());
  }
}

template <class S>
void backward(const MlpShape& shape, const S* parameters, MlpTape<S>& tape, const Matrix<S>& output_gradient,
              S* gradient, Matrix<S>* input_gradient, InputColumns columns) {
  tape.gradients.resize(shape.layers());
  for (std::size_t layer = shape.layers(); layer-- > 0;) {
    const bool last = layer + 1 == shape.layers();
    const Matrix<S>& above = last ? output_gradient : tape.gradients[layer + 1];
    const Matrix<S>& values = tape.layer_input(layer);
    if (gradient != nullptr) {
      Eigen::Map<Matrix<S>> out(gradient + shape.weight(layer), above.cols(), values.cols());
      sct::add_product(out, sct::transposed(above), sct::operand(values));
      S* bias = gradient + shape.bias(layer);
      const S* row = above.data();
      for (Index r = 0; r < above.rows(); ++r, row += above.cols())
        for (Index c = 0; c < above.cols(); ++c) bias[c] += row[c];
    }
    const auto w = weight(shape, parameters, layer);
    if (layer == 0) {
      if (input_gradient != nullptr) input_product(above, w, columns, *input_gradient);
      return;
    }
    Matrix<S>& below = tape.gradients[layer];
    below.resize(above.rows(), values.cols());
    sct::set_product(below, sct::operand(above), sct::operand(w));
    stop_at_zeros(below, values);
  }
}

std::vector<float> initial_parameters(const MlpShape& shape, std::uint64_t seed, std::uint64_t network, double last) {
  std::vector<float> parameters(shape.parameters());
  RandomStream random = random_stream(seed, RandomUse::initial, network);
  for (std::size_t layer = 0; layer < shape.layers(); ++layer) {
    const bool narrow = last > 0 && layer + 1 == shape.layers();
    const double width = narrow ? last : 1 / std::sqrt(static_cast<double>(shape.widths()[layer]));
    const std::size_t end = shape.bias(layer) + shape.widths()[layer + 1];
    for (std::size_t i = shape.weight(layer); i < end; ++i)
      parameters[i] = static_cast<float>(uniform(random, -width, width));
  }
  return parameters;
}

template struct MlpTape<float>;
template struct MlpTape<double>;
template void forward(const MlpShape&, const float*, MlpTape<float>&);
template void forward(const MlpShape&, const double*, MlpTape<double>&);
template void backward(const MlpShape&, const float*, MlpTape<float>&, const Matrix<float>&, float*, Matrix<float>*,
                       InputColumns);
template void backward(const MlpShape&, const double*, MlpTape<double>&, const Matrix<double>&, double*,
                       Matrix<double>*, InputColumns);

}  // namespace folk::mpe
