// parse_payoffs: whatever is read is a prisoner's dilemma that prints itself.

#include <folk/games/payoffs.h>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) {
    const folk::Payoffs payoffs = folk::parse_payoffs(text);
    folk::fuzz::require(folk::parse_payoffs(folk::to_text(payoffs)) == payoffs);
    folk::fuzz::require(folk::symmetric_payoffs(folk::stage_game(payoffs)) == payoffs);
    folk::dilemma_warning(payoffs);
  });
}
