#pragma once
// How the payoffs of the rounds add up to the payoff of a repeated game.

#include <folk/games/rational.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace folk {

/// A payoff criterion that cannot hold a wrong value:
///   finite:T      sum of T rounds, 1 <= T <= 10^15
///   discounted:d  (1-d) sum of d^(t-1) u_t, 0 < d < 1
///   mean          limit of the mean a round
///   ending:p      expected sum when each round is the last with probability p, 10^-15 <= p <= 1
/// d and p are kept as they were written: 0.9 is nine tenths and 2/3 two thirds, not the doubles next to them.
class Criterion {
public:
  enum class Kind { finite, discounted, mean, ending };

  /// Rounds beyond this are refused: outcome counts stay exact in a double.
  static constexpr std::uint64_t most_rounds = 1'000'000'000'000'000;

  /// A smaller ending probability is refused: it expects more than most_rounds, and 1-p would soon round to 1.
  static constexpr double least_ending = 1e-15;

  /// Each throws UsageError when its number is out of range (NaN included). A double stands for its shortest decimal.
  static Criterion finite(std::uint64_t rounds);
  static Criterion discounted(double discount);
  static Criterion discounted(const Rational& discount);
  static Criterion mean();
  static Criterion ending(double probability);
  static Criterion ending(const Rational& probability);

  /// Reads what to_string prints: "finite:100", "discounted:0.9", "discounted:2/3", "mean", "ending:0.01".
  /// Throws UsageError.
  static Criterion parse(std::string_view text);
  std::string to_string() const;

  Kind kind() const { return kind_; }
  bool is_finite() const { return kind_ == Kind::finite; }

  /// T of finite:T. Throws std::logic_error for another kind.
  std::uint64_t rounds() const;

  /// Weight of round t relative to round t-1: d for discounted, 1-p for ending, 1 for finite and mean.
  double continuation() const;

  /// The same as the number that was written.
  Rational exact_continuation() const;

  /// One less continuation(), without rounding for ending: 1-d, p, and 0 for finite and mean.
  double stopping() const;

  /// The share of the weight that is gone after this many rounds, 1 - continuation^rounds, exact also where the
  /// continuation is close to 1.
  double lost_within(double rounds) const;

  /// The fewest rounds, at least 1, after which no more than this share of the weight is left: T for finite, infinitely
  /// many for mean. 0 < share < 1.
  double rounds_until_left(double share) const;

  /// The weights of all rounds added up: T, 1, 1 and 1/p.
  double total_weight() const;

  bool operator==(const Criterion&) const = default;

private:
  Criterion(Kind kind, std::uint64_t rounds, const Rational& number)
      : kind_(kind),
        rounds_(rounds),
        number_(to_double(number)),
        exact_(number) {}

  Kind kind_;
  std::uint64_t rounds_;
  double number_;
  Rational exact_;
};

/// Reads a whole number of rounds, 1 to Criterion::most_rounds. Throws UsageError.
std::uint64_t parse_rounds(std::string_view text);

}  // namespace folk
