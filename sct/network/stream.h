#pragma once
// Windows that grow token by token, side by side: the network's hidden states at play, keys and values of past tokens
// kept.

#include <folk/sct/network/network.h>

#include <array>
#include <vector>

namespace folk::sct {

/// The tokens of one window or of several of the same length. What append() says of a token is what training would have
/// computed for it at that place; it does not depend on the windows beside it.
class Stream {
public:
  /// `network` and `parameters` must outlive this. There is room for the tokens of `rounds` rounds, of `context` when
  /// 0.
  Stream(const Network<float>& network, const float* parameters, std::size_t windows = 1, std::size_t rounds = 0);

  std::size_t windows() const { return windows_; }
  std::size_t tokens() const { return tokens_; }  ///< of each window

  /// What a layer keeps of all tokens, keys beside values; of the first window in the first tokens() rows.
  const Matrix<float>& keys_and_values(std::size_t layer) const { return keys_and_values_[layer]; }

  /// Forgets all tokens but the first `tokens`.
  void keep(std::size_t tokens) { tokens_ = std::min(tokens_, tokens); }

  /// Adds embedded tokens [windows * n, h], window after window; returns the final hidden states of the last `asked` of
  /// each [windows * asked, h].
  const Matrix<float>& append(const Matrix<float>& embedded, std::size_t asked = 1);

private:
  /// What one append() computes. A round's tokens and its belief token take turns at play: with a room for each no
  /// matrix changes its size, which costs fresh pages of memory each time.
  struct Room {
    BlockTape<float> early, last;  ///< of the blocks where all added tokens ask, in turn, and of one where some do
    BlockScratch<float> scratch;
    LayerNormTape<float> norm;
    Matrix<float> x, hidden;
  };

  const Network<float>& network_;
  const float* parameters_;
  std::size_t windows_;
  std::size_t tokens_ = 0;
  Index capacity_;                              // tokens of a window
  std::vector<Matrix<float>> keys_and_values_;  // [windows * capacity, 2h] a layer
  std::array<Room, 2> rooms_;                   // for pieces of one token and for others
};

}  // namespace folk::sct
