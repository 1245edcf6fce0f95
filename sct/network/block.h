#pragma once
// One pre-norm block of the decoder: x += attention(norm(x)), x += mlp(norm(x)); forward, in training and at play, and
// backward.

#include <folk/sct/network/attention.h>
#include <folk/sct/network/layer_norm.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace folk::sct {

/// Where a block's tensors stand.
struct BlockTensors {
  Tensor norm_1_gain, norm_1_bias, attention, attention_bias, projection, projection_bias;
  Tensor norm_2_gain, norm_2_bias, inner, inner_bias, outer, outer_bias;

  BlockTensors(const ParameterLayout& layout, std::size_t layer);
};

/// What the backward pass needs of one block.
template <class S>
struct BlockTape {
  LayerNormTape<S> norm_1;
  Matrix<S> normal_1;       ///< [tokens, h]
  Matrix<S> normal_1_read;  ///< its queries' rows, where not all are
  Matrix<S> q;              ///< [queries, h]
  Matrix<S> kv;             ///< [tokens, 2h]
  AttentionTape<S> attention;
  Matrix<S> context;  ///< [queries, h]
  std::vector<std::uint8_t> keep_projection;
  LayerNormTape<S> norm_2;
  Matrix<S> normal_2;  ///< [queries, h]
  Matrix<S> inner;     ///< after ReLU  [queries, 4h]
  std::vector<std::uint8_t> keep_outer;
};

/// Room for the intermediate results of one chunk, reused from block to block: one for blocks where every token is a
/// query and one for others, so that no matrix changes its size, which costs fresh pages of memory each time.
template <class S>
struct BlockScratch {
  struct Room {
    Matrix<S> branch;    ///< what attention or the mlp adds to x, then the gradient of what it reads  [queries, h]
    Matrix<S> d_out;     ///< [queries, h]
    Matrix<S> d_inner;   ///< [queries, 4h]
    Matrix<S> d_kv;      ///< [tokens, 2h]
    Matrix<S> d_normal;  ///< [tokens, h]
    Matrix<S> x;         ///< [queries, h] before the forward pass, then [tokens, h]
  };
  std::array<Room, 2> rooms;

  Room& room(const TokenRows& rows) { return rooms[rows.all ? 0 : 1]; }
};

/// How tokens attend at play, where keys and values of earlier ones are kept: from tape.q and tape.kv, which are of the
/// newest tokens alone, to tape.context.
template <class S>
using AttentionAtPlay = std::function<void(BlockTape<S>&)>;

/// x [tokens, h] becomes [queries, h]. With `at_play` x holds only the newest tokens, rows.row counts in x, and the
/// tape is of no use for a backward pass.
template <class S>
void block_forward(const BlockTensors& tensors, const S* parameters, const AttentionShape& shape, Matrix<S>& x,
                   BlockTape<S>& tape, BlockScratch<S>& scratch, const AttentionAtPlay<S>& at_play = nullptr);

/// dx [queries, h] becomes [tokens, h]; the parameters' gradients are added to `gradient`.
template <class S>
void block_backward(const BlockTensors& tensors, const S* parameters, const AttentionShape& shape,
                    const BlockTape<S>& tape, Matrix<S>& dx, S* gradient, BlockScratch<S>& scratch);

}  // namespace folk::sct
