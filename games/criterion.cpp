#include <folk/games/criterion.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace folk {
namespace {

/// The shortest decimal that reads back as this double: what a person wrote.
Rational as_written(double number) { return parse_rational(fmt::format("{}", number)); }

}  // namespace

std::uint64_t parse_rounds(std::string_view text) {
  std::uint64_t rounds = 0;
  const auto* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, rounds);
  if (error != std::errc() || stop != end || rounds == 0 || rounds > Criterion::most_rounds)
    throw UsageError(
        fmt::format("rounds '{}': expected a whole number from 1 to {}", excerpt(text), Criterion::most_rounds));
  return rounds;
}

double parse_number(std::string_view text, std::string_view what, double low, double high) {
  double value = 0;
  const auto* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !(value >= low && value <= high))
    throw UsageError(fmt::format("{} '{}': expected a number from {} to {}", what, excerpt(text), low, high));
  return value;
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
    const bool fraction = value.find('/') != std::string_view::npos;
    if (name == "discounted") {
      if (!fraction) parse_number(value, "discount factor", 0, 1);
      return discounted(parse_rational(value));
    }
    if (name == "ending") {
      if (!fraction) parse_number(value, "ending probability", 0, 1);
      return ending(parse_rational(value));
    }
  }
  throw UsageError(fmt::format("criterion '{}': expected finite:T, discounted:d, mean or ending:p", excerpt(text)));
}

std::string Criterion::to_string() const {
  switch (kind_) {
    case Kind::finite: return fmt::format("finite:{}", rounds_);
    case Kind::discounted: return "discounted:" + number_text();
    case Kind::mean: return "mean";
    case Kind::ending: return "ending:" + number_text();
  }
  throw std::logic_error("unknown criterion");
}

std::string Criterion::number_text() const {
  return exact_ == as_written(number_) ? fmt::format("{}", number_) : folk::to_text(exact_);
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
