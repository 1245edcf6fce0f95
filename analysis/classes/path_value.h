#pragma once
// What a path into a cycle is worth under a criterion, read off a few places of its prefix sums.

#include <folk/games/criterion.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace folk {

/// A path is given by its prefix sums s: s[t] is the sum over rounds before t of what a round is worth, times
/// round_weights()[t]. With the cycle from round b to round e (the path stands at e where it stood at b), its value is
/// first * s[b] + cycle * (s[e] - s[b]) + (s[b + rest] - s[b]); a path that ends at round b, finite:T being over, has
/// e = b.
template <class Number>
struct PathTerm {
  Number first = 0;
  Number cycle = 0;
  std::size_t rest = 0;

  /// `sums` are numbers, or several side by side.
  template <class Sums>
  Sums value(const Sums* sums, std::size_t begin, std::size_t end) const {
    return first * sums[begin] + cycle * (sums[end] - sums[begin]) + (sums[begin + rest] - sums[begin]);
  }
};

/// Number is std::int64_t, or double within 2^53, for sums that are exact: finite, and mean, where `common` is a
/// multiple of every cycle's length and values are `common` times the mean.
template <class Number>
PathTerm<Number> path_term(const Criterion& criterion, std::size_t begin, std::size_t end, Number common = 1) {
  const std::size_t length = end - begin;
  if (length == 0) return {1, 0, 0};
  switch (criterion.kind()) {
    case Criterion::Kind::finite: {
      const std::uint64_t after = criterion.rounds() < begin ? 0 : criterion.rounds() - begin;
      return {1, static_cast<Number>(after / length), after % length};
    }
    case Criterion::Kind::mean: return {0, common / static_cast<Number>(length), 0};
    case Criterion::Kind::discounted:
    case Criterion::Kind::ending: break;
  }
  return {1, static_cast<Number>(1 / criterion.lost_within(static_cast<double>(length))), 0};
}

/// The weights of rounds 0 to `rounds` - 1 in prefix sums: 1 for finite and mean.
template <class Number>
std::vector<Number> round_weights(const Criterion& criterion, std::size_t rounds) {
  std::vector<Number> weights(rounds, Number{1});
  if (criterion.is_finite() || criterion.kind() == Criterion::Kind::mean) return weights;
  double weight = criterion.kind() == Criterion::Kind::discounted ? criterion.stopping() : 1;
  for (auto& round : weights) {
    round = static_cast<Number>(weight);
    weight *= criterion.continuation();
  }
  return weights;
}

/// path_term for paths of up to `longest` rounds, each made once.
template <class Number>
class PathTerms {
public:
  PathTerms(const Criterion& criterion, std::size_t longest, Number common)
      : stride_(longest + 1),
        terms_(stride_ * stride_) {
    for (std::size_t begin = 0; begin < stride_; ++begin)
      for (std::size_t end = begin; end < stride_; ++end)
        terms_[begin * stride_ + end] = path_term(criterion, begin, end, common);
  }

  const PathTerm<Number>& operator()(std::size_t begin, std::size_t end) const { return terms_[begin * stride_ + end]; }

private:
  std::size_t stride_;
  std::vector<PathTerm<Number>> terms_;
};

}  // namespace folk
