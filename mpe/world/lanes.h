#pragma once
// Eight episodes side by side in a vector register, and the few functions of them that the world needs.
//
// Everything here is additions, products, quotients and square roots of IEEE 754 doubles without fused operations (mpe/
// is compiled so): a lane's result does not depend on its neighbours, nor on the processor. All of it is inlined in
// every build, so that the linker never puts another program's copy, with fused operations, in the place of mpe's own.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#include <immintrin.h>
#endif

namespace folk::mpe {

// A function that returns a Vector would be called differently with and without AVX-512; these are never called.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

inline constexpr std::size_t vector_lanes = 8;  ///< episodes in a register
inline constexpr std::size_t block_lanes = 64;  ///< episodes in a block: a row of a block is 512 bytes

using Vector [[gnu::vector_size(64)]] = double;
using Mask [[gnu::vector_size(64)]] = std::int64_t;  ///< -1 where it holds, else 0

[[gnu::always_inline]] inline Vector load(const double* from) {
  Vector v;
  std::memcpy(&v, __builtin_assume_aligned(from, 64), sizeof v);
  return v;
}
[[gnu::always_inline]] inline void store(double* to, const Vector& v) {
  std::memcpy(__builtin_assume_aligned(to, 64), &v, sizeof v);
}

/// Stores past the caches, for what will not be read soon.
[[gnu::always_inline]] inline void store_past_caches(double* to, const Vector& v) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  _mm512_stream_pd(to, reinterpret_cast<__m512d>(v));
#else
  store(to, v);
#endif
}

/// Orders the stores past the caches before all that follows.
[[gnu::always_inline]] inline void fence_stores() {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  _mm_sfence();
#endif
}

[[gnu::always_inline]] inline bool any(const Mask& mask) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)) != 0;
#else
  std::int64_t some = 0;
  for (std::size_t i = 0; i < vector_lanes; ++i) some |= mask[i];
  return some != 0;
#endif
}

[[gnu::always_inline]] inline Vector square_root(const Vector& v) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return reinterpret_cast<Vector>(_mm512_sqrt_pd(reinterpret_cast<__m512d>(v)));
#else
  Vector root;
  for (std::size_t i = 0; i < vector_lanes; ++i) root[i] = std::sqrt(v[i]);
  return root;
#endif
}

[[gnu::always_inline]] inline Vector all_lanes(double x) { return Vector{x, x, x, x, x, x, x, x}; }
[[gnu::always_inline]] inline Vector absolute(const Vector& v) { return v < 0 ? -v : v; }
[[gnu::always_inline]] inline Vector minimum(const Vector& a, const Vector& b) { return b < a ? b : a; }

/// The sum of terms[k] x^k, even and odd powers apart: two chains of operations that do not wait for each other.
template <std::size_t n>
[[gnu::always_inline]] inline Vector polynomial(const Vector& x, const std::array<double, n>& terms) {
  const Vector square = x * x;
  Vector even = all_lanes(terms[(n - 1) / 2 * 2]);
  Vector odd = all_lanes(terms[(n - 2) / 2 * 2 + 1]);
  for (std::size_t k = (n - 1) / 2; k-- > 0;) even = even * square + terms[2 * k];
  for (std::size_t k = (n - 2) / 2; k-- > 0;) odd = odd * square + terms[2 * k + 1];
  return even + odd * x;
}

/// exp(x) for -700 <= x <= 700, within a few units in the last place: x = n ln 2 + r, the series of exp(r), times 2^n.
[[gnu::always_inline]] inline Vector exponential(const Vector& x) {
  constexpr double shift = 0x1.8p52;  // added and taken away again, it rounds to a whole number
  constexpr double ln2_high = 0x1.62e42fee00000p-1;
  constexpr double ln2_low = 0x1.a39ef35793c76p-33;
  constexpr std::array inverse_factorials{1.0 / 2,         1.0 / 6,          1.0 / 24,          1.0 / 120,
                                          1.0 / 720,       1.0 / 5040,       1.0 / 40320,       1.0 / 362880,
                                          1.0 / 3628800.0, 1.0 / 39916800.0, 1.0 / 479001600.0, 1.0 / 6227020800.0};
  const Vector shifted = x * 0x1.71547652b82fep0 + shift;
  const Vector n = shifted - shift;
  const Vector r = (x - n * ln2_high) - n * ln2_low;
  const Vector sum = 1.0 + (r + r * r * polynomial(r, inverse_factorials));
  Mask bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  const Mask power = (bits << 52) + (std::int64_t{1023} << 52);  // the low bits of `shifted` are n
  Vector scale;
  std::memcpy(&scale, &power, sizeof scale);
  return sum * scale;
}

/// log(1 + u) for 0 <= u <= 1, within a few units in the last place: 2 artanh(u / (2 + u)).
[[gnu::always_inline]] inline Vector log_of_one_plus(const Vector& u) {
  constexpr std::array odd_inverses{1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13,
                                    1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23, 1.0 / 25,
                                    1.0 / 27, 1.0 / 29, 1.0 / 31, 1.0 / 33, 1.0 / 35, 1.0 / 37};
  const Vector s = u / (u + 2.0);
  const Vector square = s * s;
  return 2.0 * s + 2.0 * s * (square * polynomial(square, odd_inverses));
}

#pragma GCC diagnostic pop

}  // namespace folk::mpe
