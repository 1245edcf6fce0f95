#pragma once
// How many cases a test looks at.

#include <concepts>
#include <cstdlib>

namespace folk::test {

/// So many, or a tenth under a sanitizer: it asks whether memory is used as it may be, other builds ask whether all
/// values are right.
template <std::integral Number>
Number cases(Number all) {
  return std::getenv("FOLK_SANITIZED") != nullptr ? all / 10 : all;
}

}  // namespace folk::test
