// Criterion::parse: whatever is read prints itself and has weights that can be computed with.

#include <folk/games/criterion.h>

#include <cmath>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) {
    const folk::Criterion criterion = folk::Criterion::parse(text);
    folk::fuzz::require(folk::Criterion::parse(criterion.to_string()) == criterion);
    folk::fuzz::require(std::isfinite(criterion.total_weight()) && criterion.total_weight() > 0);
    folk::fuzz::require(criterion.continuation() >= 0 && criterion.continuation() <= 1);
  });
}
