#include <folk/sct/network/branches.h>
#include <folk/sct/network/gemm.h>

#include <cmath>

namespace folk::sct {
namespace {

/// Of each of `nodes` nodes of `tokens` tokens the last `asked` ask.
TokenRows last_of_each(std::size_t nodes, Index tokens, Index asked) {
  TokenRows rows;
  rows.all = asked == tokens;
  rows.first_token = {0, index(nodes) * tokens};
  rows.first_query = {0, index(nodes) * asked};
  for (Index node = 0; node < index(nodes); ++node)
    for (Index q = 0; q < asked; ++q) rows.row.push_back((node + 1) * tokens - asked + q);
  return rows;
}

}  // namespace

Branches::Branches(const Network<float>& network, const float* parameters)
    : network_(network),
      parameters_(parameters) {}

void Branches::begin(const Stream& stream, std::size_t tokens) {
  stream_ = &stream;
  before_ = tokens;
  depth_ = 0;
}

const Matrix<float>& Branches::grow(const Matrix<float>& embedded, const std::vector<std::size_t>& parents) {
  static const Dropout none;
  const auto& architecture = network_.architecture();
  node_tokens_ = embedded.rows() / index(parents.size());
  if (levels_.size() == depth_) levels_.emplace_back();
  levels_[depth_].parents = parents;
  levels_[depth_].keys_and_values.resize(architecture.layers);
  ++depth_;
  const auto every = last_of_each(parents.size(), node_tokens_, node_tokens_);
  const auto last = last_of_each(parents.size(), node_tokens_, 1);
  x_ = embedded;
  for (std::size_t l = 0; l < architecture.layers; ++l) {
    const bool some_ask = l + 1 == architecture.layers;
    const TokenRows& rows = some_ask ? last : every;
    block_forward<float>(network_.block(l), parameters_, {rows, architecture.heads, none, 0, 0}, x_,
                         some_ask ? last_ : early_, scratch_,
                         [&](BlockTape<float>& tape) { attend(l, some_ask ? 1 : node_tokens_, tape); });
  }
  layer_norm(x_, parameters_ + network_.norm_gain().offset, parameters_ + network_.norm_bias().offset, norm_, hidden_);
  return hidden_;
}

/// Keys and values of the tokens on a node's branch up to this one of its own: a row each.
void Branches::find_branch(std::size_t layer, std::size_t node, Index token, std::vector<const float*>& rows) const {
  rows.resize((depth_ - 1) * static_cast<std::size_t>(node_tokens_) + static_cast<std::size_t>(token) + 1);
  for (std::size_t level = depth_; level-- > 0; node = levels_[level].parents[node]) {
    const Matrix<float>& kv = levels_[level].keys_and_values[layer];
    const auto first = level * static_cast<std::size_t>(node_tokens_);
    for (std::size_t t = 0; t < static_cast<std::size_t>(node_tokens_) && first + t < rows.size(); ++t)
      rows[first + t] = kv.data() + (index(node) * node_tokens_ + index(t)) * kv.cols();
  }
}

/// The stream's tokens are the same for all nodes, so that they are multiplied at once; those of a branch are few.
void Branches::attend(std::size_t layer, Index asked, BlockTape<float>& tape) {
  using Row = Eigen::Map<const RowVector<float>>;
  const Index h = tape.q.cols();
  const Index width = h / index(network_.architecture().heads);
  const float scale = 1.0F / std::sqrt(static_cast<float>(width));
  const Index before = index(before_);
  const Matrix<float>& kept = stream_->keys_and_values(layer);
  levels_[depth_ - 1].keys_and_values[layer] = tape.kv;
  tape.context.resize(tape.q.rows(), h);
  std::vector<std::vector<const float*>> branches(static_cast<std::size_t>(tape.q.rows()));
  for (Index r = 0; r < tape.q.rows(); ++r)
    find_branch(layer, static_cast<std::size_t>(r / asked), node_tokens_ - asked + r % asked,
                branches[static_cast<std::size_t>(r)]);
  probability_.resize(tape.q.rows(), before + index(depth_) * node_tokens_);
  for (Index column = 0; column < h; column += width) {
    set_product(probability_.leftCols(before), operand(tape.q.middleCols(column, width)),
                transposed(kept.block(0, column, before, width)));
    for (Index r = 0; r < tape.q.rows(); ++r) {
      const auto& branch = branches[static_cast<std::size_t>(r)];
      const auto query = tape.q.row(r).segment(column, width);
      for (std::size_t t = 0; t < branch.size(); ++t)
        probability_(r, before + index(t)) = query.dot(Row(branch[t] + column, width));
      auto row = probability_.row(r).head(before + index(branch.size())).array();
      row = ((row - row.maxCoeff()) * scale).exp();
      row *= 1.0F / row.sum();
    }
    set_product(tape.context.middleCols(column, width), operand(probability_.leftCols(before)),
                operand(kept.block(0, h + column, before, width)));
    for (Index r = 0; r < tape.q.rows(); ++r) {
      const auto& branch = branches[static_cast<std::size_t>(r)];
      for (std::size_t t = 0; t < branch.size(); ++t)
        tape.context.row(r).segment(column, width) +=
            probability_(r, before + index(t)) * Row(branch[t] + h + column, width);
    }
  }
}

}  // namespace folk::sct
