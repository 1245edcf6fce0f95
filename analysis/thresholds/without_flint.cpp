// What stands for polynomial.cpp in a build without FLINT.

#include <folk/analysis/thresholds/polynomial.h>
#include <folk/games/error.h>

namespace folk {
namespace {

[[noreturn]] void refuse() {
  throw EnvironmentError(
      "this build of Folk has no threshold discount factors, for want of FLINT: install libflint-dev and build it "
      "again");
}

}  // namespace

bool flint_available() { return false; }

std::string to_text(const Polynomial& /*p*/) { refuse(); }

Polynomial greatest_common_divisor(const Polynomial& /*a*/, const Polynomial& /*b*/) { refuse(); }

Polynomial irreducible_factor(const Polynomial& /*p*/, const Rational& /*low*/, const Rational& /*high*/) { refuse(); }

RootIsolation isolate_roots(const Polynomial& /*p*/) { refuse(); }

}  // namespace folk
