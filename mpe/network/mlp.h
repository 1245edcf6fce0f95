#pragma once
// Fully connected networks with ReLU between their layers: the actors and critics of the particle world.

#include <folk/sct/network/matrix.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk::mpe {

using sct::Index;
using sct::index;
using sct::Matrix;

/// Where the layers' numbers lie in one flat buffer. Layer k: weight [widths[k + 1], widths[k]] row-major, then bias;
/// y = W x + b.
class MlpShape {
public:
  MlpShape() = default;

  /// `widths`: inputs, hidden layers, outputs; at least two of them.
  explicit MlpShape(std::vector<std::size_t> widths);

  const std::vector<std::size_t>& widths() const { return widths_; }
  std::size_t layers() const { return widths_.size() - 1; }
  std::size_t inputs() const { return widths_.front(); }
  std::size_t outputs() const { return widths_.back(); }
  std::size_t parameters() const { return biases_.back() + widths_.back(); }
  std::size_t weight(std::size_t layer) const { return weights_[layer]; }
  std::size_t bias(std::size_t layer) const { return biases_[layer]; }

  bool operator==(const MlpShape&) const = default;

private:
  std::vector<std::size_t> widths_;
  std::vector<std::size_t> weights_;  // offsets
  std::vector<std::size_t> biases_;
};

/// What a forward pass leaves for the backward pass, and its result: the input of each layer, then the output; a row
/// for each example.
template <class S>
struct MlpTape {
  std::vector<Matrix<S>> values;
  std::vector<Matrix<S>> gradients;  ///< scratch of the backward pass

  const Matrix<S>* shared_input = nullptr;  ///< somebody else's, instead of values[0]

  Matrix<S>& input() { return values.front(); }
  const Matrix<S>& layer_input(std::size_t layer) const {
    return layer == 0 && shared_input != nullptr ? *shared_input : values[layer];
  }
  const Matrix<S>& output() const { return values.back(); }

  /// Makes room for `rows` examples; the input is then to be filled in.
  void prepare(const MlpShape& shape, std::size_t rows);

  /// The same for the examples of an input that stays where it is.
  void prepare(const MlpShape& shape, const Matrix<S>& input);

private:
  void prepare_layers(const MlpShape& shape, std::size_t rows);
};

/// tape.output() of tape.input(): linear in the last layer.
template <class S>
void forward(const MlpShape& shape, const S* parameters, MlpTape<S>& tape);

/// Columns [first, first + count) of an input.
struct InputColumns {
  Index first = 0;
  Index count = 0;
};

/// From the gradient with respect to the output, adds that of the parameters to `gradient` and sets that of some
/// columns of the input; either may be null.
template <class S>
void backward(const MlpShape& shape, const S* parameters, MlpTape<S>& tape, const Matrix<S>& output_gradient,
              S* gradient, Matrix<S>* input_gradient, InputColumns columns = {});

/// Weights and biases uniform within 1/sqrt(inputs of the layer), as PyTorch's linear layers start; the last layer
/// within `last` where it is above 0.
std::vector<float> initial_parameters(const MlpShape& shape, std::uint64_t seed, std::uint64_t network,
                                      double last = 0);

}  // namespace folk::mpe
