#include <folk/games/criterion.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace folk {

std::uint64_t parse_rounds(std::string_view text) {
  return parse_whole_number(text, "rounds", 1, Criterion::most_rounds);
}

Criterion Criterion::finite(std::uint64_t rounds) {
  if (rounds == 0 || rounds > most_rounds)
    throw UsageError(fmt::format("rounds {}: expected a whole number from 1 to {}", rounds, most_rounds));
  return {Kind::finite, rounds, 1};
}

Criterion Criterion::discounted(double discount) {
  if (!(discount > 0 && discount < 1))
    throw UsageError(fmt::format("discount factor {}: expected a number above 0 and below 1", discount));
  return discounted(as_written(discount));
}

Criterion Criterion::discounted(const Rational& discount) {
  // What rounds to 0 or 1 has no double to compute with.
  if (!(to_double(discount) > 0 && to_double(discount) < 1))
    throw UsageError(
        fmt::format("discount factor {}: expected a number above 0 and below 1", excerpt(to_text(discount))));
  return {Kind::discounted, 0, discount};
}

Criterion Criterion::mean() { return {Kind::mean, 0, 1}; }

Criterion Criterion::ending(double probability) {
  if (!(probability >= least_ending && probability <= 1))
    throw UsageError(fmt::format("ending probability {}: expected a number from {} to 1", probability, least_ending));
  return ending(as_written(probability));
}

Criterion Criterion::ending(const Rational& probability) {
  if (!(to_double(probability) >= least_ending && probability <= 1))
    throw UsageError(fmt::format("ending probability {}: expected a number from {} to 1", excerpt(to_text(probability)),
                                 least_ending));
  return {Kind::ending, 0, probability};
}

Criterion Criterion::parse(std::string_view text) {
  const auto colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  if (name == "mean" && colon == std::string_view::npos) return mean();
  if (colon != std::string_view::npos) {
    const std::string_view value = text.substr(colon + 1);
    if (name == "finite") return finite(parse_rounds(value));
    if (name == "discounted") return discounted(parse_exact_number(value, "discount factor", 0, 1));
    if (name == "ending") return ending(parse_exact_number(value, "ending probability", 0, 1));
  }
  throw UsageError(fmt::format("criterion '{}': expected finite:T, discounted:d, mean or ending:p", excerpt(text)));
}

std::string Criterion::to_string() const {
  switch (kind_) {
    case Kind::finite: return fmt::format("finite:{}", rounds_);
    case Kind::discounted: return "discounted:" + to_short_text(exact_);
    case Kind::mean: return "mean";
    case Kind::ending: return "ending:" + to_short_text(exact_);
  }
  throw std::logic_error("unknown criterion");
}

Rational Criterion::exact_continuation() const {
  if (kind_ == Kind::discounted) return exact_;
  return kind_ == Kind::ending ? Rational(1 - exact_) : Rational(1);
}

std::uint64_t Criterion::rounds() const {
  if (kind_ != Kind::finite) throw std::logic_error("only a finite criterion has a number of rounds");
  return rounds_;
}

double Criterion::continuation() const {
  switch (kind_) {
    case Kind::discounted: return number_;
    case Kind::ending: return 1 - number_;
    case Kind::finite:
    case Kind::mean: return 1;
  }
  throw std::logic_error("unknown criterion");
}

double Criterion::stopping() const {
  switch (kind_) {
    case Kind::discounted: return 1 - number_;
    case Kind::ending: return number_;
    case Kind::finite:
    case Kind::mean: return 0;
  }
  throw std::logic_error("unknown criterion");
}

double Criterion::lost_within(double rounds) const { return -std::expm1(rounds * std::log1p(-stopping())); }

double Criterion::rounds_until_left(double share) const {
  if (kind_ == Kind::finite) return static_cast<double>(rounds_);
  if (kind_ == Kind::mean) return std::numeric_limits<double>::infinity();
  // Each of the two is the one that did not round; of a continuation of 0 nothing is left after a round.
  const double logarithm = stopping() < 0.5 ? std::log1p(-stopping()) : std::log(continuation());
  return std::max(1.0, std::ceil(std::log(share) / logarithm));
}

double Criterion::total_weight() const {
  switch (kind_) {
    case Kind::finite: return static_cast<double>(rounds_);
    case Kind::ending: return 1 / number_;
    case Kind::discounted:
    case Kind::mean: return 1;
  }
  throw std::logic_error("unknown criterion");
}

}  // namespace folk
