#pragma once
// Causal self-attention over the windows of a chunk (Vaswani et al. 2017), forward and backward.

#include <folk/sct/network/dropout.h>
#include <folk/sct/network/matrix.h>
#include <folk/sct/network/token_rows.h>

#include <cstdint>
#include <vector>

namespace folk::sct {

/// What the backward pass needs: of each window and head the probabilities [queries, tokens], zero beyond a query's own
/// position, and which of them dropout kept. Aligned, because Eigen adds up a row in an order that depends on where in
/// memory it begins.
template <class S>
struct AttentionTape {
  std::vector<S, Eigen::aligned_allocator<S>> probability;
  std::vector<std::uint8_t> keep;
};

/// One chunk's attention.
struct AttentionShape {
  const TokenRows& rows;
  std::size_t heads;
  const Dropout& dropout;
  std::size_t site;          ///< of the dropout
  std::size_t first_window;  ///< the place in the batch of the chunk's first window
};

/// context[i] = sum over tokens j up to query i of softmax(q_i . k_j / sqrt(h/heads)) v_j, head by head.
/// q [queries, h], kv [tokens, 2h] = keys beside values, context [queries, h].
template <class S>
void attend(const AttentionShape& shape, const Matrix<S>& q, const Matrix<S>& kv, AttentionTape<S>& tape,
            Matrix<S>& context);

/// dq and d_kv are overwritten.
template <class S>
void attend_backward(const AttentionShape& shape, const Matrix<S>& q, const Matrix<S>& kv, const AttentionTape<S>& tape,
                     const Matrix<S>& d_context, Matrix<S>& dq, Matrix<S>& d_kv);

}  // namespace folk::sct
