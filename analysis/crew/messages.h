#pragma once
// What ranks tell each other.

#include <folk/analysis/crew/packing.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace folk {

/// What a message says.
enum class Word : char {
  ready,   ///< to rank 0: `number` pieces at a time are taken; content: the identity of the work
  piece,   ///< from rank 0: do piece `number`
  result,  ///< to rank 0: piece `number` is done; content: its bytes
  failed,  ///< to rank 0: piece `number`, or (no_piece) the rank itself, has thrown; content: failure.h
  all,     ///< results of all ranks: of each piece its number, its size, its bytes
  end,     ///< the work is done, all was told
  stop,    ///< from rank 0: the work has failed; content: failure.h
  leave    ///< the program of rank 0 is over
};

inline constexpr std::uint64_t no_piece = ~std::uint64_t{0};

inline constexpr std::size_t message_head_size = 1 + 2 * sizeof(std::uint64_t);

struct MessageHead {
  Word word = Word::leave;
  std::uint64_t run = 0;  ///< of the program: the first work that is shared is 1
  std::uint64_t number = 0;
};

/// A message as bytes, and back.
inline std::shared_ptr<const std::string> message(const MessageHead& head, std::string_view content = {}) {
  auto bytes = std::make_shared<std::string>();
  bytes->reserve(message_head_size + content.size());
  pack(*bytes, head.word);
  pack(*bytes, head.run);
  pack(*bytes, head.number);
  bytes->append(content);
  return bytes;
}

inline MessageHead read_head(Unpacker& bytes) {
  MessageHead head;
  head.word = bytes.number<Word>();
  head.run = bytes.number<std::uint64_t>();
  head.number = bytes.number<std::uint64_t>();
  return head;
}

}  // namespace folk
