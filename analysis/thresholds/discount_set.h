#pragma once
// Sets of discount factors: finite unions of closed intervals relative to (0, 1), with exact ends.

#include <folk/analysis/thresholds/algebraic_number.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace folk {

/// Where finitely many weak inequalities between polynomials in d hold: [1/2, 1) is kept as [1/2, 1], (0, 1) as [0, 1];
/// points are intervals whose ends are equal.
class DiscountSet {
public:
  /// The constraint of the ends 0 and 1, which no inequality made.
  static constexpr std::size_t no_constraint = std::numeric_limits<std::size_t>::max();

  struct End {
    AlgebraicNumber at;
    std::size_t constraint = no_constraint;  ///< the caller's number of the inequality that binds here
  };

  struct Interval {
    End low;
    End high;
  };

  static DiscountSet all();
  static DiscountSet none() { return DiscountSet(); }

  bool empty() const { return intervals_.empty(); }

  /// Disjoint, ascending.
  const std::vector<Interval>& intervals() const { return intervals_; }

  /// For 0 < d < 1.
  bool contains(const Rational& d) const;

  /// Keeps the d with p(d) >= 0 and marks the ends that this makes; an end that was there already keeps its mark. True
  /// when the set became smaller.
  bool cut(const Polynomial& p, std::size_t constraint = no_constraint);

  /// Keeps what is in `other` too, whose new ends bring their marks. True when the set became smaller.
  bool intersect(const DiscountSet& other);

  /// Keeps the interval that `d` is in; nothing when there is none.
  void keep_interval_of(const Rational& d);

  /// Numbers the marks that occur anew, 0, 1, ...; returns the old numbers in the new order.
  std::vector<std::size_t> renumber_constraints();

  /// Equal as sets, whatever their marks.
  bool operator==(const DiscountSet& other) const;

private:
  std::vector<Interval> intervals_;
};

/// A rational strictly between two numbers a < b, of few binary places where there is room. The place is a little below
/// the middle and never a multiple of 1/32 when a coarse one fits, because the ends of such sets often are.
Rational rational_between(AlgebraicNumber a, AlgebraicNumber b);

/// "1/2", or "root of 3 d^2 + d - 1 in (0.43, 0.44)": the minimal polynomial and a decimal interval in which it has no
/// other root.
std::string to_text(const AlgebraicNumber& number);

/// "[1/2, 1)", "(0, 1)", "(0, 1/3] or {1/2}", "never".
std::string to_text(const DiscountSet& set);

/// The same with a decimal before each irrational end: "[0.7044 (root of 2 d^5 - d - 1), 1)".
std::string to_readable_text(const DiscountSet& set);

/// The ends as the nearest doubles: {{0.5, 1}}; always is {{0, 1}}, never {}.
std::vector<std::array<double, 2>> to_numbers(const DiscountSet& set);

/// The ends exactly: {{"1/2", "1"}}.
std::vector<std::array<std::string, 2>> to_exact_texts(const DiscountSet& set);

}  // namespace folk
