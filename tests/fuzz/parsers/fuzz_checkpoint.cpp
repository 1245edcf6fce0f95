// parse_checkpoint: whatever is read is written and read back as the same bytes. Most changes to a checkpoint end at
// its checksum; the mutator here changes a few bytes and gives them the right one.

#include <folk/games/random.h>
#include <folk/sct/files/checksum.h>
#include <folk/sct/files/little_endian.h>
#include <folk/sct/training/checkpoint.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "fuzz.h"

namespace {

constexpr std::size_t word = 8;

/// The checksum as sct/training/checkpoint.h has it: over whole words, then over the bytes that are left.
std::string with_checksum(std::string bytes) {
  folk::sct::Checksum sum;
  std::size_t at = 0;
  for (; at + word <= bytes.size(); at += word)
    sum.add(folk::sct::load_little_endian<std::uint64_t>(std::string_view(bytes).substr(at)));
  sum.add(std::string_view(bytes).substr(at));
  folk::sct::append_little_endian(bytes, sum.value());
  return bytes;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static constexpr std::uint64_t words[] = {0,
                                            1,
                                            2,
                                            3,
                                            0xFF,
                                            0x7F800000,
                                            0x7FF0000000000000,
                                            0x7FF8000000000000,
                                            0xFFFFFFFFFFFFFFFF,
                                            0x2000000000000000,
                                            1U << 20U};
  folk::RandomStream random({.seed = seed});
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
  std::string bytes(reinterpret_cast<const char*>(data), size);
  bytes.resize(bytes.size() - std::min(bytes.size(), word));
  for (std::size_t changes = 1 + below(3); changes > 0 && bytes.size() > word; --changes) {
    const std::size_t place = below(bytes.size());
    switch (below(4)) {
      case 0: bytes[place] = static_cast<char>(random()); break;
      case 1: {  // a number for another
        std::string number;
        folk::sct::append_little_endian(number, words[below(std::size(words))]);
        bytes.replace(place, number.size(), number);
        break;
      }
      case 2: bytes.erase(place, below(2 * word)); break;
      default: bytes.insert(place, bytes.substr(below(bytes.size()), below(4 * word)));
    }
  }
  bytes = with_checksum(bytes);
  std::copy_n(bytes.begin(), std::min(bytes.size(), most), data);
  return std::min(bytes.size(), most);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view bytes) {
    const auto checkpoint = folk::sct::parse_checkpoint(bytes, "fuzz.checkpoint");
    const std::string once = folk::sct::checkpoint_bytes(checkpoint);
    folk::fuzz::require(folk::sct::checkpoint_bytes(folk::sct::parse_checkpoint(once, "fuzz.checkpoint")) == once);
  });
}
