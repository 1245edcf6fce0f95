#include <folk/sct/gemm.h>
#include <folk/sct/stream.h>

#include <numeric>

namespace folk::sct {
namespace {

/// The last `queries` of `tokens` tokens ask.
TokenRows last_rows(Index tokens, Index queries) {
  TokenRows rows;
  rows.first_token = {0, tokens};
  rows.first_query = {0, queries};
  rows.position.resize(static_cast<std::size_t>(queries));
  std::iota(rows.position.begin(), rows.position.end(), tokens - queries);
  return rows;
}

}  // namespace

Stream::Stream(const Network<float>& network, const float* parameters)
    : network_(network),
      parameters_(parameters),
      keys_and_values_(network.architecture().layers) {
  const auto& architecture = network.architecture();
  for (auto& layer : keys_and_values_)
    layer.resize(index(architecture.context * architecture.round_tokens()), index(2 * architecture.hidden));
}

const Matrix<float>& Stream::append(const Matrix<float>& embedded) {
  static const Dropout none;
  const auto& architecture = network_.architecture();
  const Index h = index(architecture.hidden);
  const Index added = embedded.rows();
  const Index before = index(tokens_);
  const auto at = [&](const Tensor& tensor) { return parameters_ + tensor.offset; };
  x_ = embedded;
  for (std::size_t l = 0; l < architecture.layers; ++l) {
    const auto& block = network_.block(l);
    const auto weights = as_matrix(parameters_, block.attention);
    const auto bias = as_row(parameters_, block.attention_bias);
    layer_norm(x_, at(block.norm_1_gain), at(block.norm_1_bias), norm_, normal_);
    auto kv = keys_and_values_[l].middleRows(before, added);
    set_product(kv, operand(normal_), operand(weights.rightCols(2 * h)));
    kv.rowwise() += bias.tail(2 * h);
    if (l + 1 == architecture.layers) {  // nobody asks for the others any more
      x_ = x_.bottomRows(1).eval();
      normal_ = normal_.bottomRows(1).eval();
    }
    q_.resize(x_.rows(), h);
    set_product(q_, operand(normal_), operand(weights.leftCols(h)));
    q_.rowwise() += bias.head(h);
    const auto rows = last_rows(before + added, x_.rows());
    attend({rows, architecture.heads, none, 0, 0}, q_, keys_and_values_[l], attention_, context_);
    add_product(x_, operand(context_), operand(as_matrix(parameters_, block.projection)));
    x_.rowwise() += as_row(parameters_, block.projection_bias);
    layer_norm(x_, at(block.norm_2_gain), at(block.norm_2_bias), norm_, normal_);
    inner_.resize(x_.rows(), 4 * h);
    set_product(inner_, operand(normal_), operand(as_matrix(parameters_, block.inner)));
    inner_ = (inner_.rowwise() + as_row(parameters_, block.inner_bias)).cwiseMax(0.0F);
    add_product(x_, operand(inner_), operand(as_matrix(parameters_, block.outer)));
    x_.rowwise() += as_row(parameters_, block.outer_bias);
  }
  tokens_ += static_cast<std::size_t>(added);
  layer_norm(x_, at(network_.norm_gain()), at(network_.norm_bias()), norm_, hidden_);
  return hidden_;
}

}  // namespace folk::sct
