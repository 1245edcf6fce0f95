#include <folk/analysis/thresholds/root_isolation.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace folk {
namespace {

using Coefficients = std::vector<Integer>;

std::size_t sign_variations(const Coefficients& coefficients) {
  std::size_t variations = 0;
  int last = 0;
  for (const Integer& c : coefficients) {
    const int sign = c.sign();
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++variations;
    last = sign;
  }
  return variations;
}

/// Replaces q(x) by q(x + 1).
void shift_by_one(Coefficients& q) {
  for (std::size_t i = 0; i + 1 < q.size(); ++i)
    for (std::size_t j = q.size() - 1; j-- > i;) q[j] += q[j + 1];
}

/// Descartes' bound on the roots in (0, 1), capped at 2. The shift is watched: its passes never add variations, and
/// when neither 0 nor 1 is a root they keep their parity.
std::size_t roots_bound(const Coefficients& q) {
  if (sign_variations(q) == 0) return 0;
  Coefficients reversed(q.rbegin(), q.rend());
  std::size_t variations = 2;
  for (std::size_t i = 0; i + 1 < reversed.size(); ++i) {
    for (std::size_t j = reversed.size() - 1; j-- > i;) reversed[j] += reversed[j + 1];
    variations = sign_variations(reversed);
    if (variations == 0 || (variations == 1 && !reversed.front().is_zero())) break;
  }
  return std::min<std::size_t>(variations, 2);
}

/// The stretch (place / 2^level, (place + 1) / 2^level), mapped to (0, 1): `q` has p's roots and signs there.
struct Stretch {
  Coefficients q;
  Integer place = 0;
  unsigned level = 0;
  bool root_at_low = false;  ///< p vanishes at the lower end; q does not

  Rational low() const { return Rational(place, Integer(1) << level); }
  Rational high() const { return Rational(place + 1, Integer(1) << level); }
  bool root_at_high() const {
    Integer sum = 0;
    for (const Integer& c : q) sum += c;
    return sum.is_zero();
  }
};

/// Drops the factors x; true when there were any.
bool drop_zero_roots(Coefficients& q) {
  const auto first = std::find_if(q.begin(), q.end(), [](const Integer& c) { return !c.is_zero(); });
  const bool any = first != q.begin();
  q.erase(q.begin(), first);
  return any;
}

std::pair<Stretch, Stretch> halves(Stretch whole) {
  // 2^n q(x / 2) for the lower half, and that at x + 1 for the upper one.
  const std::size_t n = whole.q.size() - 1;
  for (std::size_t i = 0; i < n; ++i) whole.q[i] <<= static_cast<unsigned>(n - i);
  Stretch upper{whole.q, whole.place * 2 + 1, whole.level + 1, false};
  shift_by_one(upper.q);
  upper.root_at_low = drop_zero_roots(upper.q);
  return {Stretch{std::move(whole.q), whole.place * 2, whole.level + 1, whole.root_at_low}, std::move(upper)};
}

/// Bisects (0, 1). Returns false when a stretch at `deepest` is still undecided: there may be a multiple root.
class Bisection {
public:
  Bisection(RootIsolation& found, const Rational& low, const Rational& high, unsigned deepest)
      : found_(found),
        low_(low),
        high_(high),
        deepest_(deepest) {}

  bool run(Stretch stretch) {
    const std::size_t bound = roots_bound(stretch.q);
    if (bound == 0) return true;
    if (bound == 1 && !stretch.root_at_low && !stretch.root_at_high()) {
      found_.roots.push_back({stretch.low(), stretch.high()});
      return true;
    }
    if (stretch.level >= deepest_) return false;
    auto [lower, upper] = halves(std::move(stretch));
    const Rational middle = upper.low();
    const bool root_in_the_middle = upper.root_at_low;
    if (middle <= low_)
      found_.low = std::max(found_.low, middle);
    else if (!run(std::move(lower)))
      return false;
    if (root_in_the_middle) found_.roots.push_back({middle, middle});
    if (middle < high_) return run(std::move(upper));
    found_.high = std::min(found_.high, middle);
    return true;
  }

private:
  RootIsolation& found_;
  const Rational& low_;
  const Rational& high_;
  unsigned deepest_;
};

// Simple roots are rarely closer than this; a multiple one would be bisected for ever.
constexpr unsigned deep = 12;
constexpr unsigned unlimited = ~0U;

}  // namespace

RootIsolation isolate_roots(const Polynomial& p, const Rational& low, const Rational& high) {
  RootIsolation found{p.reduced_on_unit_interval(), {}, 0, 1};
  if (!Bisection(found, low, high, deep).run({found.polynomial.coefficients(), 0, 0, false})) {
    found = {squarefree_part(found.polynomial), {}, 0, 1};
    Bisection(found, low, high, unlimited).run({found.polynomial.coefficients(), 0, 0, false});
  }
  // Middles that were met on the way, with stretches between that were not searched.
  std::erase_if(found.roots, [&](const RootInterval& root) { return root.low < found.low || root.high > found.high; });
  return found;
}

}  // namespace folk
