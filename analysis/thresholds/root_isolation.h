#pragma once
// Where in (0, 1) a polynomial vanishes: each real root in an interval of its own.

#include <folk/analysis/thresholds/polynomial.h>

#include <vector>

namespace folk {

/// One root: exactly `low` when low = high, else the only root in the open interval, simple, and no root at its ends.
struct RootInterval {
  Rational low;
  Rational high;
};

/// The roots in a stretch of (0, 1).
struct RootIsolation {
  Polynomial polynomial;            ///< what has these roots as said above: the given one reduced, perhaps squarefree
  std::vector<RootInterval> roots;  ///< ascending, their open intervals disjoint
  Rational low = 0;                 ///< they are all those of (0, 1) in [low, high]
  Rational high = 1;
};

/// All distinct roots of `p` (not 0) in (0, 1) that lie in [low, high] or a stretch that holds it.
///
/// By bisection and Descartes' rule of signs (Collins & Akritas 1976): the number of sign variations of
/// (1 + x)^n q(1 / (1 + x)) bounds the number of roots of q in (0, 1), and is exact when it is 0 or 1.
RootIsolation isolate_roots(const Polynomial& p, const Rational& low = 0, const Rational& high = 1);

}  // namespace folk
