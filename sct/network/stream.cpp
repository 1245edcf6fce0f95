#include <folk/sct/network/gemm.h>
#include <folk/sct/network/stream.h>

namespace folk::sct {
namespace {

/// In each of `windows` places of `capacity` rows the last `queries` of `tokens` tokens ask.
TokenRows last_rows(std::size_t windows, Index capacity, Index tokens, Index queries) {
  TokenRows rows;
  for (std::size_t w = 0; w <= windows; ++w) {
    rows.first_token.push_back(index(w) * capacity);
    rows.first_query.push_back(index(w) * queries);
  }
  for (std::size_t w = 0; w < windows; ++w)
    for (Index q = 0; q < queries; ++q) rows.position.push_back(tokens - queries + q);
  return rows;
}

/// The last `kept` rows of each window.
void keep_last_rows(Matrix<float>& rows, std::size_t windows, Index kept) {
  const Index each = rows.rows() / index(windows);
  if (kept == each) return;
  for (std::size_t w = 0; w < windows; ++w)  // downwards, so that nothing is overwritten before it is read
    for (Index r = 0; r < kept; ++r) rows.row(index(w) * kept + r) = rows.row((index(w) + 1) * each - kept + r);
  rows.conservativeResize(index(windows) * kept, Eigen::NoChange);
}

}  // namespace

Stream::Stream(const Network<float>& network, const float* parameters, std::size_t windows, std::size_t rounds)
    : network_(network),
      parameters_(parameters),
      windows_(windows),
      capacity_(index((rounds > 0 ? rounds : network.architecture().context) * network.architecture().round_tokens())),
      keys_and_values_(network.architecture().layers) {
  for (auto& layer : keys_and_values_)
    layer.resize(index(windows) * capacity_, index(2 * network.architecture().hidden));
}

const Matrix<float>& Stream::append(const Matrix<float>& embedded, std::size_t asked) {
  static const Dropout none;
  const auto& architecture = network_.architecture();
  const Index h = index(architecture.hidden);
  const Index added = embedded.rows() / index(windows_);
  const Index before = index(tokens_);
  const auto at = [&](const Tensor& tensor) { return parameters_ + tensor.offset; };
  x_ = embedded;
  for (std::size_t l = 0; l < architecture.layers; ++l) {
    const auto& block = network_.block(l);
    const auto weights = as_matrix(parameters_, block.attention);
    const auto bias = as_row(parameters_, block.attention_bias);
    layer_norm(x_, at(block.norm_1_gain), at(block.norm_1_bias), norm_, normal_);
    kv_.resize(x_.rows(), 2 * h);
    set_product(kv_, operand(normal_), operand(weights.rightCols(2 * h)));
    kv_.rowwise() += bias.tail(2 * h);
    for (std::size_t w = 0; w < windows_; ++w)
      keys_and_values_[l].middleRows(index(w) * capacity_ + before, added) = kv_.middleRows(index(w) * added, added);
    if (l + 1 == architecture.layers) {  // nobody asks for the others any more
      keep_last_rows(x_, windows_, index(asked));
      keep_last_rows(normal_, windows_, index(asked));
    }
    q_.resize(x_.rows(), h);
    set_product(q_, operand(normal_), operand(weights.leftCols(h)));
    q_.rowwise() += bias.head(h);
    const auto rows = last_rows(windows_, capacity_, before + added, x_.rows() / index(windows_));
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
