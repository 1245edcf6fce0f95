#include <folk/analysis/thresholds/discount_set.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

namespace folk {
namespace {

using End = DiscountSet::End;
using Interval = DiscountSet::Interval;

/// The sign of p between two neighbouring roots or bounds; -1 when they are equal, as nothing is between them.
int sign_between(const Polynomial& p, const AlgebraicNumber& a, const AlgebraicNumber& b) {
  if (a.is_rational() && b.is_rational() && a.low() >= b.low()) return -1;
  // The ends of an isolating interval are no roots, unless p vanishes at 0 or 1.
  if (!a.is_rational() && a.high() <= b.low() && a.high() < 1) return p.sign_at(a.high());
  if (!b.is_rational() && a.high() <= b.low() && b.low() > 0) return p.sign_at(b.low());
  return p.sign_at(rational_between(a, b));
}

/// The closed intervals of [0, 1] where p >= 0.
std::vector<Interval> nonnegative(const Polynomial& p, std::size_t constraint) {
  const Rational low = 0;
  const Rational high = 1;
  const auto roots = roots_of(p);
  if (roots.empty()) {
    if (p.sign_at(Rational(1, 2)) < 0) return {};
    return {{End{low}, End{high}}};
  }
  std::vector<Interval> result;
  End start{low};
  bool inside = sign_between(p, low, roots.front()) > 0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const bool inside_next = sign_between(p, roots[i], i + 1 < roots.size() ? roots[i + 1] : high) > 0;
    if (!inside) start = {roots[i], constraint};
    if (!inside_next) result.push_back({start, {roots[i], constraint}});
    inside = inside_next;
  }
  if (inside) result.push_back({start, End{high}});
  return result;
}

}  // namespace

DiscountSet DiscountSet::all() {
  DiscountSet set;
  set.intervals_.push_back({End{Rational(0)}, End{Rational(1)}});
  return set;
}

bool DiscountSet::contains(const Rational& d) const {
  return std::any_of(intervals_.begin(), intervals_.end(),
                     [&](const Interval& interval) { return interval.low.at <= d && interval.high.at >= d; });
}

bool DiscountSet::cut(const Polynomial& p, std::size_t constraint) {
  if (empty() || p.is_zero()) return false;
  DiscountSet other;
  other.intervals_ = nonnegative(p, constraint);
  return intersect(other);
}

bool DiscountSet::intersect(const DiscountSet& other) {
  std::vector<Interval> common;
  bool smaller = false;
  auto mine = intervals_.begin();
  auto theirs = other.intervals_.begin();
  while (mine != intervals_.end() && theirs != other.intervals_.end()) {
    const bool their_low = theirs->low.at > mine->low.at;
    const auto high_order = theirs->high.at <=> mine->high.at;
    const Interval both{their_low ? theirs->low : mine->low, high_order < 0 ? theirs->high : mine->high};
    if (both.low.at <= both.high.at) {
      common.push_back(both);
      smaller = smaller || their_low || high_order < 0;
    }
    if (high_order < 0)
      ++theirs;
    else
      ++mine;
  }
  smaller = smaller || common.size() != intervals_.size();
  intervals_ = std::move(common);
  return smaller;
}

void DiscountSet::keep_interval_of(const Rational& d) {
  std::erase_if(intervals_, [&](const Interval& interval) { return interval.low.at > d || interval.high.at < d; });
}

std::vector<std::size_t> DiscountSet::renumber_constraints() {
  std::set<std::size_t> used;
  for (const Interval& interval : intervals_) used.insert({interval.low.constraint, interval.high.constraint});
  used.erase(no_constraint);
  const std::vector<std::size_t> old(used.begin(), used.end());
  const auto renumber = [&](std::size_t& mark) {
    if (mark != no_constraint)
      mark = static_cast<std::size_t>(std::lower_bound(old.begin(), old.end(), mark) - old.begin());
  };
  for (Interval& interval : intervals_) {
    renumber(interval.low.constraint);
    renumber(interval.high.constraint);
  }
  return old;
}

bool DiscountSet::operator==(const DiscountSet& other) const {
  return std::equal(
      intervals_.begin(), intervals_.end(), other.intervals_.begin(), other.intervals_.end(),
      [](const Interval& a, const Interval& b) { return a.low.at == b.low.at && a.high.at == b.high.at; });
}

Rational rational_between(AlgebraicNumber a, AlgebraicNumber b) {
  while (a.high() >= b.low()) {
    a.refine();
    b.refine();
  }
  const double near = 0.55 * to_double(a.high()) + 0.45 * to_double(b.low());
  for (int places = 6; places <= 40; ++places) {
    const auto odd = static_cast<std::int64_t>(std::ldexp(near, places)) | 1;
    const Rational candidate(odd, std::int64_t{1} << places);
    if (a.high() < candidate && candidate < b.low()) return candidate;
  }
  return (a.high() + b.low()) / 2;
}

std::string to_text(const AlgebraicNumber& number) {
  if (number.is_rational()) return number.low().str();
  const Polynomial minimal = number.minimal_polynomial();
  const auto roots = roots_of(minimal);
  for (unsigned places = 2;; ++places) {
    const Integer scale = pow(10, places);
    const auto floor = [&](const Rational& d) { return numerator(d) * scale / denominator(d); };
    const auto below = [&](AlgebraicNumber root) {  // irrational: it ends strictly between two decimals
      while (floor(root.low()) != floor(root.high())) root.refine();
      return floor(root.low());
    };
    const Integer start = below(number);
    if (std::count_if(roots.begin(), roots.end(), [&](const auto& root) { return below(root) == start; }) > 1) continue;
    const auto decimal = [&](const Integer& place) {
      return fmt::format("{}.{:0>{}}", (place / scale).str(), (place % scale).str(), places);
    };
    return fmt::format("root of {} in ({}, {})", to_text(minimal), decimal(start), decimal(start + 1));
  }
}

namespace {

template <class Text>
std::string set_text(const DiscountSet& set, const Text& end_text) {
  if (set.empty()) return "never";
  std::string text;
  for (const Interval& interval : set.intervals()) {
    if (!text.empty()) text += " or ";
    if (interval.low.at == interval.high.at) {
      text += fmt::format("{{{}}}", end_text(interval.low.at));
      continue;
    }
    text += fmt::format("{}{}, {}{}", interval.low.at == Rational(0) ? '(' : '[', end_text(interval.low.at),
                        end_text(interval.high.at), interval.high.at == Rational(1) ? ')' : ']');
  }
  return text;
}

}  // namespace

std::string to_text(const DiscountSet& set) {
  return set_text(set, [](const AlgebraicNumber& end) { return to_text(end); });
}

std::string to_readable_text(const DiscountSet& set) {
  return set_text(set, [](const AlgebraicNumber& end) {
    if (end.is_rational()) return to_text(end);
    return fmt::format("{:.4f} (root of {})", end.nearest(), to_text(end.minimal_polynomial()));
  });
}

std::vector<std::array<double, 2>> to_numbers(const DiscountSet& set) {
  std::vector<std::array<double, 2>> numbers;
  for (const Interval& interval : set.intervals())
    numbers.push_back({interval.low.at.nearest(), interval.high.at.nearest()});
  return numbers;
}

std::vector<std::array<std::string, 2>> to_exact_texts(const DiscountSet& set) {
  std::vector<std::array<std::string, 2>> texts;
  for (const Interval& interval : set.intervals())
    texts.push_back({to_text(interval.low.at), to_text(interval.high.at)});
  return texts;
}

}  // namespace folk
