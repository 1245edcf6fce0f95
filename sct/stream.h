#pragma once
// A window that grows token by token: the network's hidden states at play, keys and values of past tokens kept.

#include <folk/sct/network.h>

#include <vector>

namespace folk::sct {

/// The tokens of one window. What append() says of a token is what training would have computed for it at that place.
class Stream {
public:
  /// `network` and `parameters` must outlive this.
  Stream(const Network<float>& network, const float* parameters);

  std::size_t tokens() const { return tokens_; }

  /// Forgets all tokens but the first `tokens`.
  void keep(std::size_t tokens) { tokens_ = std::min(tokens_, tokens); }

  /// Adds embedded tokens [n, h]; returns the final hidden state of the last one [1, h].
  const Matrix<float>& append(const Matrix<float>& embedded);

private:
  const Network<float>& network_;
  const float* parameters_;
  std::size_t tokens_ = 0;
  std::vector<Matrix<float>> keys_and_values_;  // [tokens, 2h] a layer
  LayerNormTape<float> norm_;
  AttentionTape<float> attention_;
  Matrix<float> x_, normal_, q_, context_, out_, inner_, hidden_;
};

}  // namespace folk::sct
