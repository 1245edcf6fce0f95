#include <folk/sct/network/block.h>
#include <folk/sct/network/gemm.h>

#include <fmt/format.h>

namespace folk::sct {
namespace {

// Dropout sites of one layer follow each other from its AttentionShape's site on.
constexpr std::size_t projection_site = 1;
constexpr std::size_t outer_site = 2;

/// One mask for rows that belong to windows.
void keep_rows(const AttentionShape& shape, std::size_t site, Index columns, std::vector<std::uint8_t>& keep) {
  if (!shape.dropout.active()) return;
  keep.resize(static_cast<std::size_t>(shape.rows.queries() * columns));
  for (std::size_t w = 0; w < shape.rows.windows(); ++w)
    shape.dropout.keep(keep.data() + shape.rows.first_query[w] * columns,
                       static_cast<std::size_t>(shape.rows.window_queries(w) * columns), shape.first_window + w,
                       shape.site + site);
}

/// x += dropped(y + bias)
template <class S, class Bias>
void add_dropped(Matrix<S>& x, const Matrix<S>& y, const Bias& bias, const Dropout& dropout,
                 const std::vector<std::uint8_t>& keep) {
  if (!dropout.active()) {
    x += y;
    x.rowwise() += bias;
    return;
  }
  const S scale = static_cast<S>(dropout.scale());
  const Index columns = x.cols();
  for (Index r = 0; r < x.rows(); ++r) {
    S* __restrict to = x.data() + r * columns;
    const S* __restrict from = y.data() + r * columns;
    const S* __restrict add = bias.data();
    const std::uint8_t* __restrict kept = keep.data() + r * columns;
    for (Index c = 0; c < columns; ++c) to[c] += static_cast<S>(kept[c]) * scale * (from[c] + add[c]);
  }
}

/// dy = dx where it was kept, scaled.
template <class S>
void drop_gradient(const Matrix<S>& dx, const Dropout& dropout, const std::vector<std::uint8_t>& keep, Matrix<S>& dy) {
  dy.resize(dx.rows(), dx.cols());
  if (!dropout.active()) {
    dy = dx;
    return;
  }
  const S scale = static_cast<S>(dropout.scale());
  S* __restrict to = dy.data();
  const S* __restrict from = dx.data();
  const std::uint8_t* __restrict kept = keep.data();
  for (Index i = 0; i < dx.size(); ++i) to[i] = static_cast<S>(kept[i]) * scale * from[i];
}

template <class S>
void gather(const Matrix<S>& from, const std::vector<Index>& rows, Matrix<S>& to) {
  to.resize(index(rows.size()), from.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) to.row(index(i)) = from.row(rows[i]);
}

}  // namespace

BlockTensors::BlockTensors(const ParameterLayout& layout, std::size_t layer) {
  const auto get = [&](const char* name) { return layout[fmt::format("h.{}.{}", layer, name)]; };
  norm_1_gain = get("ln_1.weight");
  norm_1_bias = get("ln_1.bias");
  attention = get("attn.c_attn.weight");
  attention_bias = get("attn.c_attn.bias");
  projection = get("attn.c_proj.weight");
  projection_bias = get("attn.c_proj.bias");
  norm_2_gain = get("ln_2.weight");
  norm_2_bias = get("ln_2.bias");
  inner = get("mlp.c_fc.weight");
  inner_bias = get("mlp.c_fc.bias");
  outer = get("mlp.c_proj.weight");
  outer_bias = get("mlp.c_proj.bias");
}

template <class S>
void block_forward(const BlockTensors& tensors, const S* parameters, const AttentionShape& shape, Matrix<S>& x,
                   BlockTape<S>& tape, BlockScratch<S>& scratch, const AttentionAtPlay<S>& at_play) {
  const auto& rows = shape.rows;
  auto& room = scratch.room(rows);
  const Index h = x.cols();
  layer_norm(x, parameters + tensors.norm_1_gain.offset, parameters + tensors.norm_1_bias.offset, tape.norm_1,
             tape.normal_1);
  if (!rows.all) {
    gather(tape.normal_1, rows.row, tape.normal_1_read);
    gather(x, rows.row, room.x);
    x.swap(room.x);
  }
  const auto weights = as_matrix(parameters, tensors.attention);
  const auto bias = as_row(parameters, tensors.attention_bias);
  tape.q.resize(rows.queries(), h);
  tape.kv.resize(tape.normal_1.rows(), 2 * h);
  set_product(tape.q, operand(rows.all ? tape.normal_1 : tape.normal_1_read), operand(weights.leftCols(h)));
  tape.q.rowwise() += bias.head(h);
  set_product(tape.kv, operand(tape.normal_1), operand(weights.rightCols(2 * h)));
  tape.kv.rowwise() += bias.tail(2 * h);
  if (at_play)
    at_play(tape);
  else
    attend(shape, tape.q, tape.kv, tape.attention, tape.context);

  /// x += dropped(y * weight + bias)
  const auto add = [&](const Matrix<S>& y, const Tensor& weight, const Tensor& y_bias, std::size_t site,
                       std::vector<std::uint8_t>& keep) {
    if (at_play) {
      // Straight onto x, which is faster. Training adds a finished product, without dropout too: where a sum has more
      // terms than a panel of gemm.cpp the last bits differ, and what was played and trained is to remain so.
      add_product(x, operand(y), operand(as_matrix(parameters, weight)));
      x.rowwise() += as_row(parameters, y_bias);
      return;
    }
    room.branch.resize(rows.queries(), h);
    set_product(room.branch, operand(y), operand(as_matrix(parameters, weight)));
    keep_rows(shape, site, h, keep);
    add_dropped(x, room.branch, as_row(parameters, y_bias), shape.dropout, keep);
  };
  add(tape.context, tensors.projection, tensors.projection_bias, projection_site, tape.keep_projection);

  // At play the first normalisation's room, still in the cache, serves the second too.
  const bool again = at_play && rows.all;
  auto& normal_2 = again ? tape.normal_1 : tape.normal_2;
  layer_norm(x, parameters + tensors.norm_2_gain.offset, parameters + tensors.norm_2_bias.offset,
             again ? tape.norm_1 : tape.norm_2, normal_2);
  tape.inner.resize(rows.queries(), 4 * h);
  set_product(tape.inner, operand(normal_2), operand(as_matrix(parameters, tensors.inner)));
  tape.inner = (tape.inner.rowwise() + as_row(parameters, tensors.inner_bias)).cwiseMax(S(0));
  add(tape.inner, tensors.outer, tensors.outer_bias, outer_site, tape.keep_outer);
}

template <class S>
void block_backward(const BlockTensors& tensors, const S* parameters, const AttentionShape& shape,
                    const BlockTape<S>& tape, Matrix<S>& dx, S* gradient, BlockScratch<S>& scratch) {
  const auto& rows = shape.rows;
  auto& room = scratch.room(rows);
  const Index h = dx.cols();

  auto& d_out = room.d_out;
  auto& d_inner = room.d_inner;
  auto& d_read = room.branch;
  drop_gradient(dx, shape.dropout, tape.keep_outer, d_out);
  add_product(as_matrix(gradient, tensors.outer), transposed(tape.inner), operand(d_out));
  add_rows(as_row(gradient, tensors.outer_bias), d_out);
  d_inner.resize(rows.queries(), 4 * h);
  set_product(d_inner, operand(d_out), transposed(as_matrix(parameters, tensors.outer)));
  d_inner = (tape.inner.array() > S(0)).select(d_inner, S(0));
  add_product(as_matrix(gradient, tensors.inner), transposed(tape.normal_2), operand(d_inner));
  add_rows(as_row(gradient, tensors.inner_bias), d_inner);
  d_read.resize(rows.queries(), h);
  set_product(d_read, operand(d_inner), transposed(as_matrix(parameters, tensors.inner)));
  layer_norm_backward(d_read, parameters + tensors.norm_2_gain.offset, tape.norm_2,
                      gradient + tensors.norm_2_gain.offset, gradient + tensors.norm_2_bias.offset, dx);

  drop_gradient(dx, shape.dropout, tape.keep_projection, d_out);
  add_product(as_matrix(gradient, tensors.projection), transposed(tape.context), operand(d_out));
  add_rows(as_row(gradient, tensors.projection_bias), d_out);
  set_product(d_read, operand(d_out), transposed(as_matrix(parameters, tensors.projection)));
  auto& dq = room.d_out;
  auto& d_kv = room.d_kv;
  attend_backward(shape, tape.q, tape.kv, tape.attention, d_read, dq, d_kv);

  const auto weights = as_matrix(parameters, tensors.attention);
  auto d_weights = as_matrix(gradient, tensors.attention);
  auto d_bias = as_row(gradient, tensors.attention_bias);
  add_product(d_weights.leftCols(h), transposed(rows.all ? tape.normal_1 : tape.normal_1_read), operand(dq));
  add_rows(d_bias.head(h), dq);
  add_product(d_weights.rightCols(2 * h), transposed(tape.normal_1), operand(d_kv));
  add_rows(d_bias.tail(2 * h), d_kv);
  auto& d_normal = room.d_normal;
  d_normal.resize(rows.tokens(), h);
  set_product(d_normal, operand(d_kv), transposed(weights.rightCols(2 * h)));
  if (rows.all) {
    add_product(d_normal, operand(dq), transposed(weights.leftCols(h)));
  } else {
    set_product(d_read, operand(dq), transposed(weights.leftCols(h)));
    room.x.setZero(rows.tokens(), h);
    for (std::size_t i = 0; i < rows.row.size(); ++i) {
      d_normal.row(rows.row[i]) += d_read.row(index(i));
      room.x.row(rows.row[i]) = dx.row(index(i));
    }
    dx.swap(room.x);
  }
  layer_norm_backward(d_normal, parameters + tensors.norm_1_gain.offset, tape.norm_1,
                      gradient + tensors.norm_1_gain.offset, gradient + tensors.norm_1_bias.offset, dx);
}

template void block_forward(const BlockTensors&, const float*, const AttentionShape&, Matrix<float>&, BlockTape<float>&,
                            BlockScratch<float>&, const AttentionAtPlay<float>&);
template void block_forward(const BlockTensors&, const double*, const AttentionShape&, Matrix<double>&,
                            BlockTape<double>&, BlockScratch<double>&, const AttentionAtPlay<double>&);
template void block_backward(const BlockTensors&, const float*, const AttentionShape&, const BlockTape<float>&,
                             Matrix<float>&, float*, BlockScratch<float>&);
template void block_backward(const BlockTensors&, const double*, const AttentionShape&, const BlockTape<double>&,
                             Matrix<double>&, double*, BlockScratch<double>&);

}  // namespace folk::sct
