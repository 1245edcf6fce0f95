#pragma once
// The 64-bit checksum that Folk's files carry: of policies, checkpoints, data sets and a study's records.

#include <bit>
#include <cstdint>
#include <string_view>

namespace folk::sct {

/// FNV-1a over bytes for texts and over whole words for numbers, the last word mixed once more. Part of the formats
/// (docs/policy-files.md): another function would refuse every file that is out there. Signatures of what was computed
/// are analysis/play/signature.h.
class Checksum {
public:
  void add(std::string_view text) {
    for (const char c : text) absorb(static_cast<unsigned char>(c));
    absorb(0x100);  // ends the text: ("ab", "c") is not ("a", "bc")
  }

  /// The bits of a double. -0.0 counts as 0.0.
  void add(double number) { absorb(std::bit_cast<std::uint64_t>(number + 0.0)); }

  void add(std::uint64_t word) { absorb(word); }

  std::uint64_t value() const {
    std::uint64_t mixed = state_ ^ (state_ >> 32U);
    mixed *= 0x9E3779B97F4A7C15U;
    return mixed ^ (mixed >> 29U);
  }

private:
  void absorb(std::uint64_t word) {
    state_ ^= word ^ (word >> 47U);
    state_ *= 0x100000001B3U;
    state_ ^= state_ >> 33U;
  }

  std::uint64_t state_ = 0xCBF29CE484222325U;
};

}  // namespace folk::sct
