#pragma once
// Numbers as little-endian bytes, on any processor.

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

namespace folk::sct {

/// The word in the first sizeof(Word) bytes, which must be there.
template <std::unsigned_integral Word>
Word load_little_endian(std::string_view bytes) {
  Word word = 0;
  for (std::size_t i = 0; i < sizeof(Word); ++i)
    word |= static_cast<Word>(Word{static_cast<unsigned char>(bytes[i])} << (8 * i));
  return word;
}

template <std::unsigned_integral Word>
void append_little_endian(std::string& bytes, Word word) {
  for (std::size_t i = 0; i < sizeof(Word); ++i) bytes += static_cast<char>((word >> (8 * i)) & 0xFFU);
}

}  // namespace folk::sct
