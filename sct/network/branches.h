#pragma once
// What may come after a window, in several ways at once: tokens that see the window and those above them on their own
// branch, level by level.

#include <folk/sct/network/network.h>
#include <folk/sct/network/stream.h>

#include <cstddef>
#include <vector>

namespace folk::sct {

/// A tree of continuations. What grow() says of a node is what Stream::append would have said of its last token, had
/// the window gone on along its branch, up to rounding.
class Branches {
public:
  /// `network` and `parameters` must outlive this.
  Branches(const Network<float>& network, const float* parameters);

  /// Forgets all nodes; the next ones follow the first `tokens` tokens of `stream`, a stream of one window that must
  /// stay as it is as long as they are added to.
  void begin(const Stream& stream, std::size_t tokens);

  /// Adds a level of `parents.size()` nodes, each of as many embedded tokens [nodes * n, h], node after node; n is the
  /// same for all levels. `parents`: each node's place in the level before, of no account for the first level. Returns
  /// the final hidden states of the nodes' last tokens [nodes, h].
  const Matrix<float>& grow(const Matrix<float>& embedded, const std::vector<std::size_t>& parents);

private:
  struct Level {
    std::vector<std::size_t> parents;
    std::vector<Matrix<float>> keys_and_values;  // [nodes * n, 2h] a layer
  };

  void find_branch(std::size_t layer, std::size_t node, Index token, std::vector<const float*>& rows) const;
  void attend(std::size_t layer, Index asked, BlockTape<float>& tape);

  const Network<float>& network_;
  const float* parameters_;
  const Stream* stream_ = nullptr;
  std::size_t before_ = 0;  // tokens of the stream
  Index node_tokens_ = 0;
  std::vector<Level> levels_;
  std::size_t depth_ = 0;  // levels that are in use
  BlockTape<float> early_, last_;
  BlockScratch<float> scratch_;
  LayerNormTape<float> norm_;
  Matrix<float> x_, hidden_, probability_;
};

}  // namespace folk::sct
