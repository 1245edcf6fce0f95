#pragma once
// Batch normalisation of a network's input over the rows of a batch (Ioffe & Szegedy 2015), as PyTorch's BatchNorm1d
// has it, and networks that share one.

#include <folk/mpe/network/mlp.h>
#include <folk/mpe/network/policy_network.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace folk::mpe {

inline constexpr double batch_norm_epsilon = 1e-5;
inline constexpr double batch_norm_momentum = 0.1;  ///< the newest batch's share in the running numbers

/// What a forward pass leaves for the backward pass.
template <class S>
struct BatchNormTape {
  Matrix<S> normal;              ///< (x - mean) / sqrt(variance + epsilon) [rows, inputs]
  std::vector<double> mean;      ///< of the batch [inputs]
  std::vector<double> variance;  ///< of the batch, the squares' sum over the number of rows [inputs]
  std::vector<S> inverse;        ///< 1 / sqrt(variance + epsilon) [inputs]
};

/// y = normal * weight + bias [rows, inputs], with the mean and variance of the rows of x themselves.
template <class S>
void batch_norm(const Matrix<S>& x, const S* weight, const S* bias, BatchNormTape<S>& tape, Matrix<S>& y);

/// From dy, the gradient with respect to y: adds those of the weight and the bias.
template <class S>
void batch_norm_backward(const Matrix<S>& dy, const BatchNormTape<S>& tape, S* d_weight, S* d_bias);

/// From dy, the gradient with respect to some columns of y: sets that of the same columns of x, through the batch's
/// mean and variance too.
template <class S>
void batch_norm_input_backward(const Matrix<S>& dy, const S* weight, const BatchNormTape<S>& tape, InputColumns columns,
                               Matrix<S>& dx);

/// What is remembered of all batches, to act on single observations: mean and variance move to the batch's by the
/// momentum, the variance to its unbiased estimate. The batch has two rows or more.
template <class S>
void remember_batch(const BatchNormTape<S>& tape, std::vector<float>& mean, std::vector<float>& variance);

/// x normalised in place with remembered numbers instead of its own.
template <class S>
void normalise(const InputNormalisation& normalisation, Matrix<S>& x);

/// Networks of one shape that see the same normalised input: an actor, or twin critics. In one flat buffer: the
/// normalisation's weight [inputs] and bias [inputs], then one network after the other.
class NormalisedShape {
public:
  NormalisedShape() = default;
  NormalisedShape(MlpShape network, std::size_t networks);

  const MlpShape& network() const { return network_; }
  std::size_t networks() const { return networks_; }
  std::size_t inputs() const { return network_.inputs(); }
  std::size_t bias() const { return inputs(); }
  std::size_t network_begin(std::size_t k) const { return 2 * inputs() + k * network_.parameters(); }
  std::size_t parameters() const { return network_begin(networks_); }

private:
  MlpShape network_;
  std::size_t networks_ = 0;
};

/// What a forward pass leaves; its input is to be filled in before. Holds pointers to itself: not to be copied.
template <class S>
struct NormalisedTape {
  Matrix<S> input;
  Matrix<S> normalised;
  BatchNormTape<S> norm;
  std::vector<MlpTape<S>> networks;
  Matrix<S> input_gradient;  ///< scratch of the backward pass
  Matrix<S> other_gradient;

  NormalisedTape() = default;
  NormalisedTape(const NormalisedTape&) = delete;
  NormalisedTape& operator=(const NormalisedTape&) = delete;

  const Matrix<S>& output(std::size_t network) const { return networks[network].output(); }
};

/// The outputs of tape.input, of the first `networks` networks.
template <class S>
void forward(const NormalisedShape& shape, const S* parameters, NormalisedTape<S>& tape, std::size_t networks);

/// From the gradients with respect to the outputs of the first networks, adds those of all parameters.
template <class S>
void backward(const NormalisedShape& shape, const S* parameters, NormalisedTape<S>& tape,
              std::span<const Matrix<S>> output_gradients, S* gradient);

/// From the gradient with respect to the first network's output, sets that of some columns of the input.
template <class S>
void input_backward(const NormalisedShape& shape, const S* parameters, NormalisedTape<S>& tape,
                    const Matrix<S>& output_gradient, InputColumns columns, Matrix<S>& input_gradient);

/// The normalisation's weight 1 and bias 0; network k as initial_parameters(shape, seed, first + k) has it, but for the
/// weights of the last layer, uniform within `last` where it is above 0.
std::vector<float> initial_parameters(const NormalisedShape& shape, std::uint64_t seed, std::uint64_t first,
                                      double last = 0);

}  // namespace folk::mpe
