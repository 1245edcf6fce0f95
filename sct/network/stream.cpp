#include <folk/sct/network/stream.h>

#include <utility>

namespace folk::sct {
namespace {

/// In each of `windows` places of `capacity` rows the last `queries` of `tokens` tokens ask, of which `added` are new.
TokenRows last_rows(std::size_t windows, Index capacity, Index tokens, Index added, Index queries) {
  TokenRows rows;
  rows.all = queries == added;
  for (std::size_t w = 0; w <= windows; ++w) {
    rows.first_token.push_back(index(w) * capacity);
    rows.first_query.push_back(index(w) * queries);
  }
  for (std::size_t w = 0; w < windows; ++w)
    for (Index q = 0; q < queries; ++q) {
      rows.position.push_back(tokens - queries + q);
      rows.row.push_back((index(w) + 1) * added - queries + q);
    }
  return rows;
}

/// What is of all added tokens in both tapes: one place in memory, and in the cache, does for both.
void exchange_tokens(BlockTape<float>& a, BlockTape<float>& b) {
  std::swap(a.norm_1, b.norm_1);
  a.normal_1.swap(b.normal_1);
  a.kv.swap(b.kv);
}

/// The rows of kv, as many of each window, behind those of the tokens before.
void keep_keys(const Matrix<float>& kv, const TokenRows& rows, Index before, Matrix<float>& kept) {
  const Index added = kv.rows() / index(rows.windows());
  for (std::size_t w = 0; w < rows.windows(); ++w)
    kept.middleRows(rows.first_token[w] + before, added) = kv.middleRows(index(w) * added, added);
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
  const Index added = embedded.rows() / index(windows_);
  const Index before = index(tokens_);
  const auto every = last_rows(windows_, capacity_, before + added, added, added);
  const auto wanted = last_rows(windows_, capacity_, before + added, added, index(asked));
  auto& room = rooms_[added == 1 ? 0 : 1];
  room.x = embedded;
  for (std::size_t l = 0; l < architecture.layers; ++l) {
    const bool some_ask = l + 1 == architecture.layers && !wanted.all;  // nobody wants the other tokens any more
    const AttentionShape shape{some_ask ? wanted : every, architecture.heads, none, 0, 0};
    if (some_ask) exchange_tokens(room.early, room.last);
    block_forward<float>(network_.block(l), parameters_, shape, room.x, some_ask ? room.last : room.early, room.scratch,
                         [&](BlockTape<float>& tape) {
                           keep_keys(tape.kv, shape.rows, before, keys_and_values_[l]);
                           attend(shape, tape.q, keys_and_values_[l], tape.attention, tape.context);
                         });
    if (some_ask) exchange_tokens(room.early, room.last);
  }
  tokens_ += static_cast<std::size_t>(added);
  layer_norm(room.x, parameters_ + network_.norm_gain().offset, parameters_ + network_.norm_bias().offset, room.norm,
             room.hidden);
  if (!wanted.all) room.x.swap(room.scratch.room(wanted).x);  // back to the size that the next piece needs
  return room.hidden;
}

}  // namespace folk::sct
