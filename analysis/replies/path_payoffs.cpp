#include <folk/analysis/play/whole_payoffs.h>
#include <folk/analysis/replies/path_payoffs.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

Rational power(const Rational& base, std::size_t exponent) {
  const auto n = static_cast<unsigned>(exponent);
  return Rational(pow(numerator(base), n), pow(denominator(base), n));
}

}  // namespace

PathPayoffs::PathPayoffs(const PlayPath& path, const Payoffs& payoffs, const Criterion& criterion)
    : criterion_(criterion),
      payoffs_(payoffs.by_outcome()),
      numbers_(payoffs.numbers()),
      rounds_(path.rounds) {
  if (rounds_.empty()) throw std::logic_error("a path of no rounds");
  if (criterion.is_finite() != (!path.cycle && !path.cut)) throw std::logic_error("a path of another criterion");
  const WholePayoffs whole = whole_payoffs(payoffs);
  scale_ = whole.scale;
  exact_scale_ = whole.exact_scale;
  const std::size_t n = rounds_.size();
  if (criterion.is_finite()) {
    if (!whole.exact(static_cast<double>(n)))
      throw UsageError(
          fmt::format("{} rounds at {} would score too much to count exactly: play fewer", n, to_text(payoffs)));
    tails_.assign(n + 1, 0);
    for (std::size_t t = n; t-- > 0;) tails_[t] = tails_[t + 1] + whole.by_outcome[rounds_[t].index()];
    doubt_ = 16 * 0x1p-53 * static_cast<double>(n) * whole.largest / scale_;
    return;
  }
  std::vector<std::uint32_t> next;
  std::vector<double> rewards;
  for (std::size_t t = 0; t < n; ++t) {
    next.push_back(static_cast<std::uint32_t>(t + 1));
    rewards.push_back(whole.by_outcome[rounds_[t].index()]);
  }
  if (path.cycle) {
    next.back() = static_cast<std::uint32_t>(*path.cycle);
  } else {
    next.push_back(static_cast<std::uint32_t>(n));
    rewards.push_back(*std::max_element(whole.by_outcome.begin(), whole.by_outcome.end()));
  }
  flow_.emplace(std::move(next), std::move(rewards), exact_scale_, criterion);
  doubt_ = 4 * flow_->doubt();
}

Rational PathPayoffs::from(std::size_t round) const {
  if (flow_) return flow_->value(static_cast<std::uint32_t>(round));
  return Rational(static_cast<std::int64_t>(tails_[round])) / exact_scale_;
}

double PathPayoffs::rounded_from(std::size_t round) const {
  return flow_ ? flow_->values()[round] : tails_[round] / scale_;
}

Rational PathPayoffs::gain(std::size_t round, const Rational& rate) const {
  const Rational& now = payoffs_[rounds_[round].deviated().index()];
  const Rational d = criterion_.exact_continuation();
  switch (criterion_.kind()) {
    case Criterion::Kind::finite: return now + Rational(rounds() - round - 1) * rate - from(round);
    case Criterion::Kind::mean: return rate - from(round);
    case Criterion::Kind::discounted: return power(d, round) * ((1 - d) * now + d * rate - from(round));
    case Criterion::Kind::ending: break;
  }
  return power(d, round) * (now + d / (1 - d) * rate - from(round));
}

double PathPayoffs::rounded_gain(std::size_t round, double rate) const {
  const double now = numbers_[rounds_[round].deviated().index()];
  const double d = criterion_.continuation();
  switch (criterion_.kind()) {
    case Criterion::Kind::finite: return now + static_cast<double>(rounds() - round - 1) * rate - rounded_from(round);
    case Criterion::Kind::mean: return rate - rounded_from(round);
    case Criterion::Kind::discounted: return criterion_.stopping() * now + d * rate - rounded_from(round);
    case Criterion::Kind::ending: break;
  }
  return now + d / criterion_.stopping() * rate - rounded_from(round);
}

double PathPayoffs::weight(std::size_t round) const {
  return std::pow(criterion_.continuation(), static_cast<double>(round));
}

}  // namespace folk
