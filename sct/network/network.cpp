#include <folk/sct/network/network.h>

#include <numeric>

namespace folk::sct {

template <class S>
Network<S>::Network(const Architecture& architecture)
    : architecture_(architecture),
      layout_(architecture),
      embedding_(layout_, architecture),
      norm_gain_(layout_["ln_f.weight"]),
      norm_bias_(layout_["ln_f.bias"]) {
  for (std::size_t l = 0; l < architecture.layers; ++l) blocks_.emplace_back(layout_, l);
}

template <class S>
AttentionShape Network<S>::shape(const Chunk<S>& chunk, const Pass<S>& pass, const NetworkTape<S>& tape,
                                 std::size_t layer) const {
  constexpr std::size_t sites_a_block = 3;
  return {layer + 1 == architecture_.layers ? tape.rows : tape.all_rows, architecture_.heads, pass.dropout,
          1 + layer * sites_a_block, chunk.first_window};
}

template <class S>
void Network<S>::forward(const S* parameters, const Chunk<S>& chunk, const Pass<S>& pass, NetworkTape<S>& tape) const {
  std::vector<std::size_t> every(architecture_.round_tokens());
  std::iota(every.begin(), every.end(), std::size_t{0});
  tape.all_rows = TokenRows(chunk.window_rounds, every.size(), every);
  tape.rows = TokenRows(chunk.window_rounds, every.size(), pass.read);
  tape.blocks.resize(architecture_.layers);
  embed(architecture_, embedding_, parameters, chunk, pass.opponent, tape.all_rows, pass.dropout, tape.embedding,
        tape.x);
  for (std::size_t l = 0; l < architecture_.layers; ++l)
    block_forward(blocks_[l], parameters, shape(chunk, pass, tape, l), tape.x, tape.blocks[l], tape.scratch);
  layer_norm(tape.x, parameters + norm_gain_.offset, parameters + norm_bias_.offset, tape.norm, tape.hidden);
}

template <class S>
void Network<S>::backward(const S* parameters, const Chunk<S>& chunk, const Pass<S>& pass, NetworkTape<S>& tape,
                          Matrix<S>& d_hidden, S* gradient, Matrix<S>* d_opponent) const {
  auto& dx = tape.x;
  dx.setZero(d_hidden.rows(), d_hidden.cols());
  layer_norm_backward(d_hidden, parameters + norm_gain_.offset, tape.norm, gradient + norm_gain_.offset,
                      gradient + norm_bias_.offset, dx);
  for (std::size_t l = architecture_.layers; l-- > 0;)
    block_backward(blocks_[l], parameters, shape(chunk, pass, tape, l), tape.blocks[l], dx, gradient, tape.scratch);
  embed_backward(architecture_, embedding_, parameters, chunk, pass.opponent, tape.all_rows, pass.dropout,
                 tape.embedding, dx, gradient, d_opponent);
}

template class Network<float>;
template class Network<double>;

}  // namespace folk::sct
