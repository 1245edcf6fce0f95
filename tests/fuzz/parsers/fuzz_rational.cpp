// parse_rational: whatever is read is printed, read back as the same number, and has a double.

#include <folk/games/rational.h>

#include <cmath>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) {
    const folk::Rational value = folk::parse_rational(text);
    folk::fuzz::require(folk::parse_rational(folk::to_text(value)) == value);
    folk::fuzz::require(!std::isnan(folk::to_double(value)));
  });
}
