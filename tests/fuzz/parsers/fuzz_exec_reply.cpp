// parse_reply: whatever a program on the other end of a pipe answers is a move, perhaps with a probability, or refused.

#include <folk/strategies/programs/exec_player.h>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view line) {
    const folk::Reply reply = folk::parse_reply(line);
    folk::fuzz::require(line.front() == folk::to_char(reply.move));
    if (reply.belief) folk::fuzz::require(*reply.belief >= 0 && *reply.belief <= 1);
  });
}
