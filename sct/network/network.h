#pragma once
// The transformer from windows to hidden states: embeddings, blocks, final normalisation; forward and backward.

#include <folk/sct/network/block.h>
#include <folk/sct/network/embedding.h>

#include <vector>

namespace folk::sct {

/// Room for one chunk's pass, and what its backward pass needs.
template <class S>
struct NetworkTape {
  TokenRows rows;      ///< of the last block: queries are the read tokens
  TokenRows all_rows;  ///< of the blocks before it
  EmbeddingTape<S> embedding;
  std::vector<BlockTape<S>> blocks;
  LayerNormTape<S> norm;
  Matrix<S> hidden;  ///< the read tokens' final states  [rounds * read tokens, h]
  BlockScratch<S> scratch;
  Matrix<S> x;
};

/// Which opponent actions stand in the belief slots, what is dropped, whose states are read.
template <class S>
struct Pass {
  const Actions<S>& opponent;
  const Dropout& dropout;
  const std::vector<std::size_t>& read;  ///< tokens of a round, ascending
};

/// A decoder-only transformer; its parameters and gradients are flat buffers in the order of ParameterLayout.
template <class S>
class Network {
public:
  explicit Network(const Architecture& architecture);

  const Architecture& architecture() const { return architecture_; }
  const ParameterLayout& layout() const { return layout_; }

  /// Where the parts' tensors stand.
  const EmbeddingTensors& embedding() const { return embedding_; }
  const BlockTensors& block(std::size_t layer) const { return blocks_[layer]; }
  const Tensor& norm_gain() const { return norm_gain_; }
  const Tensor& norm_bias() const { return norm_bias_; }

  /// Fills tape.hidden.
  void forward(const S* parameters, const Chunk<S>& chunk, const Pass<S>& pass, NetworkTape<S>& tape) const;

  /// Adds to `gradient` what d_hidden (of the size of tape.hidden; overwritten) does to the parameters. With
  /// `d_opponent`, the gradient of the numbers in the belief slots is written there.
  void backward(const S* parameters, const Chunk<S>& chunk, const Pass<S>& pass, NetworkTape<S>& tape,
                Matrix<S>& d_hidden, S* gradient, Matrix<S>* d_opponent = nullptr) const;

private:
  AttentionShape shape(const Chunk<S>& chunk, const Pass<S>& pass, const NetworkTape<S>& tape, std::size_t layer) const;

  Architecture architecture_;
  ParameterLayout layout_;
  EmbeddingTensors embedding_;
  std::vector<BlockTensors> blocks_;
  Tensor norm_gain_, norm_bias_;
};

}  // namespace folk::sct
