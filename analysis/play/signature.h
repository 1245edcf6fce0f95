#pragma once
// A 64-bit signature of what was computed: runs that differ in it differ in something that was added.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace folk {

class Automaton;

/// XXH3 with 64 bits (Collet, xxHash; seed 0) over the little-endian bytes of all that was added. It guards against
/// mistakes, not against intent. What files carry is sealed by another function, sct/files/checksum.h.
class Signature {
public:
  Signature();
  ~Signature();
  Signature(const Signature&) = delete;
  Signature& operator=(const Signature&) = delete;

  /// The text's length as a word, then its bytes: ("ab", "c") is not ("a", "bc").
  void add(std::string_view text);

  /// The bits of a double. -0.0 counts as 0.0.
  void add(double number) { add(std::bit_cast<std::uint64_t>(number + 0.0)); }

  void add(std::uint64_t word) {
    if (waiting_ == block_.size()) hand_over();
    for (unsigned byte = 0; byte < 8; ++byte) block_[waiting_ + byte] = static_cast<unsigned char>(word >> (8 * byte));
    waiting_ += 8;
  }

  /// Its nodes, its start and where unseen moves lead: minimal automata that behave alike are the same.
  void add(const Automaton& automaton);

  /// Of what was added so far; more may be added afterwards.
  std::uint64_t value() const;

private:
  struct State;

  void hand_over();

  // Words wait here: a call of the library for each would cost more than its arithmetic.
  std::array<unsigned char, 512> block_;
  std::size_t waiting_ = 0;
  std::unique_ptr<State> state_;
};

}  // namespace folk
