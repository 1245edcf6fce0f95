#pragma once
// Small machines and numbers from a fuzzer's bytes: every input is one, so that nothing is wasted on refusals.

#include <folk/strategies/automaton.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace folk::fuzz {

/// The input, byte by byte; zeros after its end.
class Bytes {
public:
  Bytes(const std::uint8_t* data, std::size_t size)
      : data_(data),
        size_(size) {}

  std::uint32_t next() { return at_ < size_ ? data_[at_++] : 0; }
  std::uint32_t below(std::uint32_t bound) { return next() % bound; }

private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

/// A machine of 1 to `most_states` states, each five bytes: its move, or with `mixes` also some chances between, and
/// where the four outcomes lead.
inline Automaton machine(Bytes& bytes, std::uint32_t most_states, bool mixes = false) {
  const std::uint32_t size = 1 + bytes.below(most_states);
  std::vector<Automaton::Node> nodes;
  for (std::uint32_t s = 0; s < size; ++s) {
    Automaton::Node node;
    node.cooperation = mixes ? bytes.below(5) / 4.0 : bytes.below(2);
    for (auto& next : node.next) next = bytes.below(size);
    nodes.push_back(node);
  }
  return Automaton(std::move(nodes), bytes.below(size));
}

}  // namespace folk::fuzz
