#include <folk/sct/network/attention.h>
#include <folk/sct/network/gemm.h>

#include <algorithm>
#include <cmath>

namespace folk::sct {
namespace {

/// Queries that are computed together: keys beyond the last one's position are left out.
constexpr Index block_queries = 40;

/// Calls body(window, head, first query of the block, queries, keys, place of the block's probabilities) for each
/// block.
template <class Body>
void for_blocks(const AttentionShape& shape, Body&& body) {
  const auto& rows = shape.rows;
  Index place = 0;
  for (std::size_t w = 0; w < rows.windows(); ++w)
    for (std::size_t head = 0; head < shape.heads; ++head) {
      const Index end = rows.first_query[w + 1];
      for (Index first = rows.first_query[w]; first < end; first += block_queries) {
        const Index queries = std::min(block_queries, end - first);
        const Index keys = rows.position[static_cast<std::size_t>(first + queries - 1)] + 1;
        body(w, index(head), first, queries, keys, place);
        place += queries * rows.window_tokens(w);
      }
    }
}

std::size_t window_probabilities(const AttentionShape& shape, std::size_t w) {
  return shape.heads * static_cast<std::size_t>(shape.rows.window_queries(w) * shape.rows.window_tokens(w));
}

}  // namespace

template <class S>
void attend(const AttentionShape& shape, const Matrix<S>& q, const Matrix<S>& kv, AttentionTape<S>& tape,
            Matrix<S>& context) {
  const auto& rows = shape.rows;
  const Index h = q.cols();
  const Index width = h / index(shape.heads);
  const S scale = S(1) / std::sqrt(static_cast<S>(width));
  std::size_t size = 0;
  for (std::size_t w = 0; w < rows.windows(); ++w) size += window_probabilities(shape, w);
  tape.probability.resize(size);
  if (shape.dropout.active()) {
    tape.keep.resize(size);
    std::size_t place = 0;
    for (std::size_t w = 0; w < rows.windows(); ++w) {
      shape.dropout.keep(tape.keep.data() + place, window_probabilities(shape, w), shape.first_window + w, shape.site);
      place += window_probabilities(shape, w);
    }
  }
  const S kept_scale = static_cast<S>(shape.dropout.scale());
  context.resize(rows.queries(), h);
  Matrix<S> kept(block_queries, 0);
  RowVector<S> aligned;  // where vectorised exponentials and sums begin, and so their last bits, depends on the address
  for_blocks(shape, [&](std::size_t w, Index head, Index first, Index queries, Index keys, Index place) {
    const Index token = rows.first_token[w];
    Eigen::Map<Matrix<S>> p(tape.probability.data() + place, queries, keys);
    const auto k = kv.block(token, head * width, keys, width);
    const auto v = kv.block(token, h + head * width, keys, width);
    set_product(p, operand(q.block(first, head * width, queries, width)), transposed(k));
    if (aligned.size() < keys) aligned.resize(keys);
    for (Index i = 0; i < queries; ++i) {
      const Index seen = rows.position[static_cast<std::size_t>(first + i)] + 1;
      auto row = aligned.head(seen).array();
      row = p.row(i).head(seen);
      row = ((row - row.maxCoeff()) * scale).exp();
      p.row(i).head(seen) = row * (S(1) / row.sum());
      p.row(i).tail(keys - seen).setZero();
    }
    auto out = context.block(first, head * width, queries, width);
    if (!shape.dropout.active()) {
      set_product(out, operand(p), operand(v));
      return;
    }
    const std::uint8_t* keep = tape.keep.data() + place;
    kept.resize(queries, keys);
    for (Index i = 0; i < queries * keys; ++i) kept.data()[i] = p.data()[i] * (keep[i] != 0 ? kept_scale : S(0));
    set_product(out, operand(kept), operand(v));
  });
}

template <class S>
void attend_backward(const AttentionShape& shape, const Matrix<S>& q, const Matrix<S>& kv, const AttentionTape<S>& tape,
                     const Matrix<S>& d_context, Matrix<S>& dq, Matrix<S>& d_kv) {
  const auto& rows = shape.rows;
  const Index h = q.cols();
  const Index width = h / index(shape.heads);
  const S scale = S(1) / std::sqrt(static_cast<S>(width));
  const S kept_scale = static_cast<S>(shape.dropout.scale());
  dq.resize(rows.queries(), h);
  d_kv.setZero(rows.tokens(), 2 * h);
  Matrix<S> kept;
  Matrix<S> dp;
  for_blocks(shape, [&](std::size_t w, Index head, Index first, Index queries, Index keys, Index place) {
    const Index token = rows.first_token[w];
    const Eigen::Map<const Matrix<S>> p(tape.probability.data() + place, queries, keys);
    const auto queries_block = q.block(first, head * width, queries, width);
    const auto k = kv.block(token, head * width, keys, width);
    const auto v = kv.block(token, h + head * width, keys, width);
    const auto d_out = d_context.block(first, head * width, queries, width);
    dp.resize(queries, keys);
    set_product(dp, operand(d_out), transposed(v));
    auto dv = d_kv.block(token, h + head * width, keys, width);
    if (shape.dropout.active()) {
      const std::uint8_t* keep = tape.keep.data() + place;
      kept.resize(queries, keys);
      for (Index i = 0; i < queries * keys; ++i) {
        const S factor = keep[i] != 0 ? kept_scale : S(0);
        kept.data()[i] = p.data()[i] * factor;
        dp.data()[i] *= factor;
      }
      add_product(dv, transposed(kept), operand(d_out));
    } else {
      add_product(dv, transposed(p), operand(d_out));
    }
    for (Index i = 0; i < queries; ++i) {
      const S along = dp.row(i).dot(p.row(i));
      dp.row(i).array() = p.row(i).array() * (dp.row(i).array() - along) * scale;
    }
    set_product(dq.block(first, head * width, queries, width), operand(dp), operand(k));
    add_product(d_kv.block(token, head * width, keys, width), transposed(dp), operand(queries_block));
  });
}

template void attend(const AttentionShape&, const Matrix<float>&, const Matrix<float>&, AttentionTape<float>&,
                     Matrix<float>&);
template void attend(const AttentionShape&, const Matrix<double>&, const Matrix<double>&, AttentionTape<double>&,
                     Matrix<double>&);
template void attend_backward(const AttentionShape&, const Matrix<float>&, const Matrix<float>&,
                              const AttentionTape<float>&, const Matrix<float>&, Matrix<float>&, Matrix<float>&);
template void attend_backward(const AttentionShape&, const Matrix<double>&, const Matrix<double>&,
                              const AttentionTape<double>&, const Matrix<double>&, Matrix<double>&, Matrix<double>&);

}  // namespace folk::sct
