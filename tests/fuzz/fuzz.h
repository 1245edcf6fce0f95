#pragma once
// What every fuzz target shares: a parser may refuse an input, in one line, and do nothing else wrong.

#include <folk/games/error.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace folk::fuzz {

/// Ends the program unless `holds`: both fuzzers then report the input.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Hands the input to `parser` as text. A folk::Error with a message of one line is a right answer; another exception
/// goes through and is a crash.
template <class Parser>
int only_folk_errors(const std::uint8_t* data, std::size_t size, Parser parser) {
  try {
    parser(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const Error& error) {
    const std::string_view message = error.what();
    require(!message.empty());
    for (const char c : message) require(static_cast<unsigned char>(c) >= 0x20);
  }
  return 0;
}

}  // namespace folk::fuzz
