#pragma once
// How far the mean of a sample may lie from its expectation.

#include <cstddef>

namespace folk {

/// The empirical Bernstein bound (Maurer & Pontil, COLT 2009, theorem 4): the expectation of n independent samples that
/// lie in an interval of length `range` exceeds their mean by at most
///   sqrt(2 V ln(2 / failure) / n) + 7 range ln(2 / failure) / (3 (n - 1))
/// with probability 1 - failure, V being their unbiased variance; likewise it falls short of it by at most that. Unlike
/// a standard error it is not 0 where all samples happen to be equal. Of fewer than two samples: the range.
/// In the unit of `range`; `variance` in its square. Throws std::logic_error for a negative variance or range and for a
/// failure outside (0, 1).
double bernstein_bound(double variance, double range, std::size_t samples, double failure);

}  // namespace folk
