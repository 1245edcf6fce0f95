#include <folk/analysis/thresholds/polynomial.h>

#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>

#include <utility>

namespace folk {
namespace {

struct ThreadMemory {  // FLINT keeps some for each thread: it goes when the thread does
  ~ThreadMemory() { flint_cleanup(); }
};

/// FLINT's form of a polynomial. It lives within one call, so that none passes from thread to thread.
struct Flint : fmpz_poly_struct {
  explicit Flint(const std::vector<Integer>& coefficients = {}) {
    thread_local const ThreadMemory memory;
    fmpz_poly_init2(this, static_cast<slong>(coefficients.size()));
    for (const Integer& c : coefficients) fmpz_set_str(coeffs + length++, c.str().c_str(), 10);
    _fmpz_poly_normalise(this);
  }
  Flint& operator=(Flint&&) = delete;
  ~Flint() { fmpz_poly_clear(this); }
  const Flint* self() const { return this; }
};

Polynomial taken_from(const fmpz_poly_struct& poly) {
  std::vector<Integer> coefficients;
  for (const fmpz* c = poly.coeffs; c != poly.coeffs + poly.length; ++c) {
    std::string digits(fmpz_sizeinbase(c, 10) + 2, '\0');
    coefficients.emplace_back(fmpz_get_str(digits.data(), 10, c));
  }
  return Polynomial(std::move(coefficients));
}

/// Descartes' bound on the roots in (place, place + 1) / 2^level: the sign variations of (1 + x)^n p(1 / (1 + x)),
/// where p(x) = q((x + place) / 2^level).
int roots_bound(const Flint& q, const Integer& place, unsigned level) {
  Flint p;
  fmpz_poly_set(&p, &q);
  _fmpz_poly_scale_2exp(p.coeffs, p.length, -static_cast<slong>(level));
  fmpz_poly_taylor_shift(&p, &p, Flint({place, 1}).coeffs);
  fmpz_poly_reverse(&p, &p, p.length);
  fmpz_poly_taylor_shift(&p, &p, Flint({1}).coeffs);
  int variations = 0;
  int last = 0;
  for (slong i = 0; i < p.length; ++i)
    if (const int sign = fmpz_sgn(p.coeffs + i)) variations += std::exchange(last, sign) == -sign;
  return variations;
}

/// Looks for the roots there; `q` is found.polynomial.
void bisect(RootIsolation& found, const Flint& q, const Integer& place, unsigned level) {
  const int bound = roots_bound(q, place, level);
  if (bound == 0) return;
  const Rational low(place, Integer(1) << level);
  const Rational high(place + 1, Integer(1) << level);
  if (bound == 1 && found.polynomial.crosses(low, high)) {
    found.roots.emplace_back(low, high);
    return;
  }
  bisect(found, q, 2 * place, level + 1);
  const Rational middle = (low + high) / 2;
  if (found.polynomial.sign_at(middle) == 0) found.roots.emplace_back(middle, middle);
  bisect(found, q, 2 * place + 1, level + 1);
}

}  // namespace

bool flint_available() { return true; }

std::string to_text(const Polynomial& p) {
  char* pretty = fmpz_poly_get_str_pretty(Flint(p.coefficients()).self(), "d");  // 3*d^2+d-1
  std::string text;
  for (const char* c = pretty; *c != 0; ++c)
    text += *c == '*' ? " " : c > pretty && (*c == '+' || *c == '-') ? std::string{' ', *c, ' '} : std::string{*c};
  flint_free(pretty);
  return text;
}

Polynomial greatest_common_divisor(const Polynomial& a, const Polynomial& b) {
  Flint divisor(a.coefficients());
  fmpz_poly_gcd(&divisor, &divisor, Flint(b.coefficients()).self());
  fmpz_poly_primitive_part(&divisor, &divisor);
  return taken_from(divisor);
}

Polynomial irreducible_factor(const Polynomial& p, const Rational& low, const Rational& high) {
  fmpz_poly_factor_t factors;
  fmpz_poly_factor_init(factors);
  fmpz_poly_factor(factors, Flint(p.coefficients()).self());
  Polynomial factor;
  for (slong i = 0; i < factors->num && !factor.crosses(low, high); ++i) factor = taken_from(factors->p[i]);
  fmpz_poly_factor_clear(factors);
  return factor;
}

RootIsolation isolate_roots(const Polynomial& p) {
  Flint q(p.coefficients());
  Flint repeated;
  fmpz_poly_derivative(&repeated, &q);
  fmpz_poly_gcd(&repeated, &q, &repeated);
  fmpz_poly_div(&q, &q, &repeated);
  fmpz_poly_remove(&q, &q, Flint({0, 1}).self());
  fmpz_poly_remove(&q, &q, Flint({1, -1}).self());
  fmpz_poly_primitive_part(&q, &q);
  RootIsolation found{taken_from(q), {}};
  bisect(found, q, 0, 0);
  return found;
}

}  // namespace folk
