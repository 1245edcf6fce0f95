#include <folk/sct/network/embedding.h>
#include <folk/sct/network/gemm.h>

#include <type_traits>
#include <utility>

namespace folk::sct {
namespace {

constexpr std::size_t embedding_site = 0;

/// The linear embedding of `size` numbers: out += W x + b, W [h, size].
template <class S, class Row>
void add_linear(const Tensor& weight, const Tensor& bias, const S* parameters, const S* numbers, Row&& out) {
  const auto w = as_matrix(parameters, weight);
  out += as_row(parameters, bias);
  for (Index i = 0; i < w.cols(); ++i)
    if (numbers[i] != S(0)) out += w.col(i).transpose() * numbers[i];
}

template <class S, class Row>
void linear_backward(const Tensor& weight, const Tensor& bias, S* gradient, const S* numbers, const Row& d_out) {
  auto dw = as_matrix(gradient, weight);
  as_row(gradient, bias) += d_out;
  for (Index i = 0; i < dw.cols(); ++i)
    if (numbers[i] != S(0)) dw.col(i) += d_out.transpose() * numbers[i];
}

/// Classes: token by token, what is zero left out.
template <class S>
void embed_classes(const Architecture& architecture, const EmbeddingTensors& tensors, const S* parameters,
                   const Chunk<S>& chunk, const Actions<S>& opponent, Matrix<S>& sum) {
  const auto n = architecture.agents;
  const auto time = as_matrix(parameters, tensors.time);
  Index row = 0;
  for (std::size_t t = chunk.first_round; t < chunk.first_round + chunk.rounds(); ++t) {
    const auto token = [&](std::size_t which) {
      auto out = sum.row(row + index(which));
      out = time.row(chunk.batch.timesteps[t]);
      return out;
    };
    add_linear(tensors.returns, tensors.returns_bias, parameters, &chunk.batch.returns[t],
               token(architecture.return_token()));
    for (std::size_t i = 0; i < n; ++i)
      add_linear(tensors.observation, tensors.observation_bias, parameters,
                 chunk.batch.observations.data() + (t * n + i) * architecture.observation_size,
                 token(architecture.observation_token(i)));
    if (architecture.belief_token)
      token(architecture.opponent_token()) += as_matrix(parameters, tensors.opponent).row(opponent.classes[t]);
    for (std::size_t i = 0; i < n; ++i)
      token(architecture.action_token(i)) += as_matrix(parameters, tensors.own).row(chunk.batch.own.classes[t * n + i]);
    row += index(architecture.round_tokens());
  }
}

template <class S>
void classes_backward(const Architecture& architecture, const EmbeddingTensors& tensors, const Chunk<S>& chunk,
                      const Actions<S>& opponent, const Matrix<S>& d_sum, S* gradient) {
  const auto n = architecture.agents;
  auto d_time = as_matrix(gradient, tensors.time);
  Index row = 0;
  for (std::size_t t = chunk.first_round; t < chunk.first_round + chunk.rounds(); ++t) {
    const auto token = [&](std::size_t which) { return d_sum.row(row + index(which)); };
    for (std::size_t k = 0; k < architecture.round_tokens(); ++k) d_time.row(chunk.batch.timesteps[t]) += token(k);
    linear_backward(tensors.returns, tensors.returns_bias, gradient, &chunk.batch.returns[t],
                    token(architecture.return_token()));
    for (std::size_t i = 0; i < n; ++i)
      linear_backward(tensors.observation, tensors.observation_bias, gradient,
                      chunk.batch.observations.data() + (t * n + i) * architecture.observation_size,
                      token(architecture.observation_token(i)));
    if (architecture.belief_token)
      as_matrix(gradient, tensors.opponent).row(opponent.classes[t]) += token(architecture.opponent_token());
    for (std::size_t i = 0; i < n; ++i)
      as_matrix(gradient, tensors.own).row(chunk.batch.own.classes[t * n + i]) += token(architecture.action_token(i));
    row += index(architecture.round_tokens());
  }
}

/// One token of every round, where all tokens are linear in numbers.
template <class S>
struct NumberToken {
  std::size_t token;
  const Tensor& weight;
  const Tensor& bias;
  Operand<S> numbers;  ///< [rounds, size]
};

template <class S>
std::vector<NumberToken<S>> number_tokens(const Architecture& architecture, const EmbeddingTensors& tensors,
                                          const Chunk<S>& chunk, const Actions<S>& opponent) {
  std::vector<NumberToken<S>> tokens;
  const Index rounds = index(chunk.rounds());
  /// Of one of `players` whose `size` numbers stand side by side in each round.
  const auto add = [&](std::size_t token, const Tensor& weight, const Tensor& bias, const std::vector<S>& numbers,
                       std::size_t player, std::size_t players) {
    const auto size = weight.columns();
    tokens.push_back({token,
                      weight,
                      bias,
                      {numbers.data() + (chunk.first_round * players + player) * size, rounds, index(size),
                       index(players * size), 1}});
  };
  const auto& batch = chunk.batch;
  const auto n = architecture.agents;
  add(architecture.return_token(), tensors.returns, tensors.returns_bias, batch.returns, 0, 1);
  for (std::size_t i = 0; i < n; ++i)
    add(architecture.observation_token(i), tensors.observation, tensors.observation_bias, batch.observations, i, n);
  if (architecture.belief_token)
    add(architecture.opponent_token(), tensors.opponent, tensors.opponent_bias, opponent.numbers, 0, 1);
  for (std::size_t i = 0; i < n; ++i)
    add(architecture.action_token(i), tensors.own, tensors.own_bias, batch.own.numbers, i, n);
  return tokens;
}

/// A token of all rounds, one a row.
template <class M>
auto every_round(M& tokens, const Architecture& architecture, std::size_t token) {
  const Index n = index(architecture.round_tokens());
  using Plain = std::conditional_t<std::is_const_v<M>, const Matrix<typename M::Scalar>, Matrix<typename M::Scalar>>;
  return Eigen::Map<Plain, 0, Eigen::OuterStride<>>(tokens.row(index(token)).data(), tokens.rows() / n, tokens.cols(),
                                                    Eigen::OuterStride<>(n * tokens.cols()));
}

/// Numbers: a product for each token of all rounds.
template <class S>
void embed_numbers(const Architecture& architecture, const EmbeddingTensors& tensors, const S* parameters,
                   const Chunk<S>& chunk, const Actions<S>& opponent, Matrix<S>& sum) {
  const auto time = as_matrix(parameters, tensors.time);
  for (const auto& part : number_tokens(architecture, tensors, chunk, opponent)) {
    auto out = every_round(sum, architecture, part.token);
    const auto bias = as_row(parameters, part.bias);
    for (Index t = 0; t < out.rows(); ++t)
      out.row(t) = time.row(chunk.batch.timesteps[chunk.first_round + static_cast<std::size_t>(t)]) + bias;
    add_product(out, part.numbers, transposed(as_matrix(parameters, part.weight)));
  }
}

template <class S>
void numbers_backward(const Architecture& architecture, const EmbeddingTensors& tensors, const Chunk<S>& chunk,
                      const Actions<S>& opponent, const Matrix<S>& d_sum, S* gradient) {
  auto d_time = as_matrix(gradient, tensors.time);
  for (const auto& part : number_tokens(architecture, tensors, chunk, opponent)) {
    const auto d = every_round(d_sum, architecture, part.token);
    for (Index t = 0; t < d.rows(); ++t)
      d_time.row(chunk.batch.timesteps[chunk.first_round + static_cast<std::size_t>(t)]) += d.row(t);
    add_product(as_matrix(gradient, part.weight), transposed(d), part.numbers);
    add_rows(as_row(gradient, part.bias), d);
  }
}

}  // namespace

EmbeddingTensors::EmbeddingTensors(const ParameterLayout& layout, const Architecture& architecture)
    : time(layout["embed_timestep.weight"]),
      returns(layout["embed_return.weight"]),
      returns_bias(layout["embed_return.bias"]),
      observation(layout["embed_state.weight"]),
      observation_bias(layout["embed_state.bias"]),
      opponent(layout["embed_opoact.weight"]),
      own(layout["embed_curact.weight"]),
      norm_gain(layout["embed_ln.weight"]),
      norm_bias(layout["embed_ln.bias"]) {
  if (architecture.discrete) return;
  opponent_bias = layout["embed_opoact.bias"];
  own_bias = layout["embed_curact.bias"];
}

template <class S>
void embed(const Architecture& architecture, const EmbeddingTensors& tensors, const S* parameters,
           const Chunk<S>& chunk, const Actions<S>& opponent, const TokenRows& rows, const Dropout& dropout,
           EmbeddingTape<S>& tape, Matrix<S>& x) {
  tape.sum.resize(rows.tokens(), index(architecture.hidden));
  if (architecture.discrete)
    embed_classes(architecture, tensors, parameters, chunk, opponent, tape.sum);
  else
    embed_numbers(architecture, tensors, parameters, chunk, opponent, tape.sum);
  layer_norm(tape.sum, parameters + tensors.norm_gain.offset, parameters + tensors.norm_bias.offset, tape.norm, x);
  if (!dropout.active()) return;
  tape.keep.resize(static_cast<std::size_t>(x.size()));
  for (std::size_t w = 0; w < rows.windows(); ++w)
    dropout.keep(tape.keep.data() + rows.first_token[w] * x.cols(),
                 static_cast<std::size_t>(rows.window_tokens(w) * x.cols()), chunk.first_window + w, embedding_site);
  const S scale = static_cast<S>(dropout.scale());
  for (Index i = 0; i < x.size(); ++i) x.data()[i] *= static_cast<S>(tape.keep[static_cast<std::size_t>(i)]) * scale;
}

template <class S>
void embed_backward(const Architecture& architecture, const EmbeddingTensors& tensors, const S* parameters,
                    const Chunk<S>& chunk, const Actions<S>& opponent, const TokenRows& rows, const Dropout& dropout,
                    const EmbeddingTape<S>& tape, Matrix<S>& dx, S* gradient, Matrix<S>* d_opponent) {
  if (dropout.active()) {
    const S scale = static_cast<S>(dropout.scale());
    for (Index i = 0; i < dx.size(); ++i)
      dx.data()[i] *= static_cast<S>(tape.keep[static_cast<std::size_t>(i)]) * scale;
  }
  Matrix<S> d_sum = Matrix<S>::Zero(rows.tokens(), dx.cols());
  layer_norm_backward(dx, parameters + tensors.norm_gain.offset, tape.norm, gradient + tensors.norm_gain.offset,
                      gradient + tensors.norm_bias.offset, d_sum);
  if (architecture.discrete)
    classes_backward(architecture, tensors, chunk, opponent, d_sum, gradient);
  else
    numbers_backward(architecture, tensors, chunk, opponent, d_sum, gradient);
  if (d_opponent == nullptr) return;
  d_opponent->setZero(index(chunk.rounds()), index(architecture.action_size));
  if (!architecture.belief_token) return;
  const auto d = every_round(std::as_const(d_sum), architecture, architecture.opponent_token());
  set_product(*d_opponent, operand(d), operand(as_matrix(parameters, tensors.opponent)));
}

template void embed(const Architecture&, const EmbeddingTensors&, const float*, const Chunk<float>&,
                    const Actions<float>&, const TokenRows&, const Dropout&, EmbeddingTape<float>&, Matrix<float>&);
template void embed(const Architecture&, const EmbeddingTensors&, const double*, const Chunk<double>&,
                    const Actions<double>&, const TokenRows&, const Dropout&, EmbeddingTape<double>&, Matrix<double>&);
template void embed_backward(const Architecture&, const EmbeddingTensors&, const float*, const Chunk<float>&,
                             const Actions<float>&, const TokenRows&, const Dropout&, const EmbeddingTape<float>&,
                             Matrix<float>&, float*, Matrix<float>*);
template void embed_backward(const Architecture&, const EmbeddingTensors&, const double*, const Chunk<double>&,
                             const Actions<double>&, const TokenRows&, const Dropout&, const EmbeddingTape<double>&,
                             Matrix<double>&, double*, Matrix<double>*);

}  // namespace folk::sct
