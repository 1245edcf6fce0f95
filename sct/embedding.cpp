#include <folk/sct/embedding.h>

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

template <class S, class Row>
void add_action(bool discrete, const Tensor& weight, const Tensor& bias, const S* parameters, const Actions<S>& actions,
                std::size_t which, std::size_t size, Row&& out) {
  if (discrete)
    out += as_matrix(parameters, weight).row(actions.classes[which]);
  else
    add_linear(weight, bias, parameters, actions.numbers.data() + which * size, out);
}

template <class S, class Row>
void action_backward(bool discrete, const Tensor& weight, const Tensor& bias, S* gradient, const Actions<S>& actions,
                     std::size_t which, std::size_t size, const Row& d_out) {
  if (discrete)
    as_matrix(gradient, weight).row(actions.classes[which]) += d_out;
  else
    linear_backward(weight, bias, gradient, actions.numbers.data() + which * size, d_out);
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
  const auto n = architecture.agents;
  const auto size = architecture.action_size;
  tape.sum.resize(rows.tokens(), index(architecture.hidden));
  const auto time = as_matrix(parameters, tensors.time);
  Index row = 0;
  for (std::size_t t = chunk.first_round; t < chunk.first_round + chunk.rounds(); ++t) {
    const auto token = [&](std::size_t which) {
      auto out = tape.sum.row(row + index(which));
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
      add_action(architecture.discrete, tensors.opponent, tensors.opponent_bias, parameters, opponent, t, size,
                 token(architecture.opponent_token()));
    for (std::size_t i = 0; i < n; ++i)
      add_action(architecture.discrete, tensors.own, tensors.own_bias, parameters, chunk.batch.own, t * n + i, size,
                 token(architecture.action_token(i)));
    row += index(architecture.round_tokens());
  }
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
  const auto n = architecture.agents;
  const auto size = architecture.action_size;
  if (dropout.active()) {
    const S scale = static_cast<S>(dropout.scale());
    for (Index i = 0; i < dx.size(); ++i)
      dx.data()[i] *= static_cast<S>(tape.keep[static_cast<std::size_t>(i)]) * scale;
  }
  Matrix<S> d_sum = Matrix<S>::Zero(rows.tokens(), dx.cols());
  layer_norm_backward(dx, parameters + tensors.norm_gain.offset, tape.norm, gradient + tensors.norm_gain.offset,
                      gradient + tensors.norm_bias.offset, d_sum);
  if (d_opponent != nullptr) d_opponent->setZero(index(chunk.rounds()), index(size));
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
    if (architecture.belief_token) {
      const auto d_token = token(architecture.opponent_token());
      action_backward(architecture.discrete, tensors.opponent, tensors.opponent_bias, gradient, opponent, t, size,
                      d_token);
      if (d_opponent != nullptr)
        d_opponent->row(index(t - chunk.first_round)) = d_token * as_matrix(parameters, tensors.opponent);
    }
    for (std::size_t i = 0; i < n; ++i)
      action_backward(architecture.discrete, tensors.own, tensors.own_bias, gradient, chunk.batch.own, t * n + i, size,
                      token(architecture.action_token(i)));
    row += index(architecture.round_tokens());
  }
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
