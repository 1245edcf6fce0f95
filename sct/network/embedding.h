#pragma once
// Tokens out of a match: what each token's numbers and its round add up to, normalised; forward and backward.

#include <folk/sct/network/batch.h>
#include <folk/sct/network/dropout.h>
#include <folk/sct/network/layer_norm.h>
#include <folk/sct/network/token_rows.h>

#include <vector>

namespace folk::sct {

/// Where the embeddings' tensors stand.
struct EmbeddingTensors {
  Tensor time, returns, returns_bias, observation, observation_bias;
  Tensor opponent, opponent_bias, own, own_bias;  // biases of continuous actions only
  Tensor norm_gain, norm_bias;

  EmbeddingTensors(const ParameterLayout& layout, const Architecture& architecture);
};

template <class S>
struct EmbeddingTape {
  LayerNormTape<S> norm;
  Matrix<S> sum;  ///< before normalisation  [tokens, h]
  std::vector<std::uint8_t> keep;
};

/// x [tokens, h]; `opponent` stands in the belief slots: the batch's own, or beliefs.
template <class S>
void embed(const Architecture& architecture, const EmbeddingTensors& tensors, const S* parameters,
           const Chunk<S>& chunk, const Actions<S>& opponent, const TokenRows& rows, const Dropout& dropout,
           EmbeddingTape<S>& tape, Matrix<S>& x);

/// Takes dx apart. With `d_opponent` [rounds of the chunk, action_size], the gradient of continuous beliefs is written
/// there.
template <class S>
void embed_backward(const Architecture& architecture, const EmbeddingTensors& tensors, const S* parameters,
                    const Chunk<S>& chunk, const Actions<S>& opponent, const TokenRows& rows, const Dropout& dropout,
                    const EmbeddingTape<S>& tape, Matrix<S>& dx, S* gradient, Matrix<S>* d_opponent);

}  // namespace folk::sct
