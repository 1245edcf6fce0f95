#include <folk/games/criterion.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace folk {

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
  return {Kind::finite, rounds, 1.0};
}

Criterion Criterion::discounted(double discount) {
  if (!(discount > 0 && discount < 1))
    throw UsageError(fmt::format("discount factor {}: expected a number above 0 and below 1", discount));
  return {Kind::discounted, 0, discount};
}

Criterion Criterion::mean() { return {Kind::mean, 0, 1.0}; }

Criterion Criterion::ending(double probability) {
  if (!(probability >= least_ending && probability <= 1))
    throw UsageError(fmt::format("ending probability {}: expected a number from {} to 1", probability, least_ending));
  return {Kind::ending, 0, probability};
}

Criterion Criterion::parse(std::string_view text) {
  const auto colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  if (name == "mean" && colon == std::string_view::npos) return mean();
  if (colon != std::string_view::npos) {
    const std::string_view value = text.substr(colon + 1);
    if (name == "finite") return finite(parse_rounds(value));
    if (name == "discounted") return discounted(parse_number(value, "discount factor", 0, 1));
    if (name == "ending") return ending(parse_number(value, "ending probability", 0, 1));
  }
  throw UsageError(fmt::format("criterion '{}': expected finite:T, discounted:d, mean or ending:p", excerpt(text)));
}

std::string Criterion::to_string() const {
  switch (kind_) {
    case Kind::finite: return fmt::format("finite:{}", rounds_);
    case Kind::discounted: return fmt::format("discounted:{}", number_);
    case Kind::mean: return "mean";
    case Kind::ending: return fmt::format("ending:{}", number_);
  }
  throw std::logic_error("unknown criterion");
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
