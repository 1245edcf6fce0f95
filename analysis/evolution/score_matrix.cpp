#include <folk/analysis/evolution/score_matrix.h>
#include <folk/analysis/play/signature.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/games/error.h>
#include <folk/strategies/names.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace folk {
namespace {

/// Scores that were rounded keep so many binary digits of the largest.
constexpr int kept_digits = 40;

/// A double as the fraction that it is.
Rational fraction(double number) {
  int exponent = 0;
  const double mantissa = std::frexp(number, &exponent);
  const auto digits = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
  exponent -= 53;
  return exponent >= 0 ? Rational(Integer(digits) << static_cast<unsigned>(exponent))
                       : Rational(Integer(digits), Integer(1) << static_cast<unsigned>(-exponent));
}

/// The weight of all rounds, exactly.
Rational total_weight(const Criterion& criterion) {
  switch (criterion.kind()) {
    case Criterion::Kind::finite: return criterion.rounds();
    case Criterion::Kind::ending: return Rational(1) / (Rational(1) - criterion.exact_continuation());
    default: return 1;
  }
}

}  // namespace

ScoreMatrix::ScoreMatrix(const Tournament& tournament)
    : weight_(total_weight(tournament.settings().criterion)) {
  const auto& settings = tournament.settings();
  if (!settings.self_play)
    throw UsageError("a population of copies needs what each earns against its own: play with self-play");
  const std::size_t n = tournament.size();
  behaviours_ = tournament.behaviours();
  std::vector<std::size_t> member(behaviours_, n);
  for (std::size_t i = n; i-- > 0;) member[tournament.behaviour(i)] = i;
  for (std::size_t i = 0; i < n; ++i) {
    names_.push_back(tournament.name(i));
    behaviour_of_.push_back(tournament.behaviour(i));
  }
  std::vector<double> scaled;
  scaled.reserve(behaviours_ * behaviours_);
  cooperations_.reserve(behaviours_ * behaviours_);
  for (const std::size_t i : member)
    for (const std::size_t j : member) {
      const Method method = tournament.method(i, j);
      if (method == Method::bounded)
        throw UsageError(
            fmt::format("{} against {}: no limit of what they earn is proved under {}: one of them has "
                        "infinitely many states; give a horizon (--rounds N) or leave it out",
                        tournament.name(i), tournament.name(j), settings.criterion.to_string()));
      exact_ = exact_ && is_exact(method, settings.criterion);
      scaled.push_back(tournament.scaled_score(i, j));
      cooperations_.push_back(tournament.cooperation(i, j));
    }
  unit_ = Rational(1) / whole_payoffs(settings.payoffs).exact_scale;
  take_whole(scaled);
  finish();
}

ScoreMatrix::ScoreMatrix(std::vector<std::string> names, const std::vector<std::vector<Rational>>& scores,
                         const Rational& weight, std::vector<double> cooperations, bool rounded)
    : names_(std::move(names)),
      behaviours_(names_.size()),
      cooperations_(std::move(cooperations)),
      weight_(weight) {
  if (names_.empty()) throw UsageError("a table of scores needs at least one strategy");
  std::set<std::string> seen;
  for (const auto& name : names_)
    if (!seen.insert(name_identity(name)).second)
      throw UsageError(fmt::format("strategy '{}' is in the table twice", excerpt(name)));
  if (scores.size() != size() ||
      std::any_of(scores.begin(), scores.end(), [&](const auto& r) { return r.size() != size(); }))
    throw UsageError(fmt::format("a table of scores of {} strategies needs as many rows of as many numbers", size()));
  if (!cooperations_.empty() && cooperations_.size() != size() * size())
    throw UsageError("the table of cooperations has not the size of that of the scores");
  for (std::size_t i = 0; i < size(); ++i) behaviour_of_.push_back(i);
  Integer denominator = 1;
  Integer largest = 0;
  exact_ = !rounded;
  for (std::size_t i = 0; i < size() && exact_; ++i)
    for (std::size_t j = 0; j < size() && exact_; ++j) {
      denominator = lcm(denominator, scores[i][j].denominator());
      exact_ = denominator.fits_word();  // beyond that the numbers came from somewhere where they were rounded
    }
  if (exact_)
    for (const auto& row : scores)
      for (const auto& score : row) {
        const Integer whole = abs(score.numerator()) * (denominator / score.denominator());
        if (whole > largest) largest = whole;
      }
  exact_ = exact_ && largest <= Integer(std::int64_t{1} << 53);
  if (exact_) {
    for (const auto& row : scores)
      for (const auto& score : row) whole_.push_back((score.numerator() * (denominator / score.denominator())).word());
    unit_ = Rational(Integer(1), denominator);
  } else {
    std::vector<double> numbers;
    for (const auto& row : scores)
      for (const auto& score : row) numbers.push_back(to_double(score));
    take_whole(numbers);
  }
  finish();
}

/// Numbers in the present unit, whole ones where exact.
void ScoreMatrix::take_whole(const std::vector<double>& scores) {
  double largest = 0;
  for (const double score : scores) largest = std::max(largest, std::abs(score));
  if (!std::isfinite(largest)) throw UsageError("a score is not finite");
  int shift = 0;
  if (!exact_ && largest > 0) {
    std::frexp(largest, &shift);
    shift = kept_digits - shift;
  } else if (std::any_of(scores.begin(), scores.end(), [](double score) { return score != std::floor(score); })) {
    shift = 1;  // a player that is not the same in both seats earns the mean of the two against its copy
  }
  unit_ /= fraction(std::ldexp(1, shift));
  for (const double score : scores) whole_.push_back(std::llround(std::ldexp(score, shift)));
}

void ScoreMatrix::finish() {
  unit_number_ = to_double(unit_);
  weight_number_ = to_double(weight_);
}

Rational ScoreMatrix::exact_payoff(std::size_t i, std::size_t j) const {
  return unit_ * Rational(whole(behaviour_of_[i], behaviour_of_[j])) / weight_;
}

void ScoreMatrix::require_no_negative_score() const {
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t j = 0; j < size(); ++j)
      if (whole(behaviour_of_[i], behaviour_of_[j]) < 0)
        throw UsageError(
            fmt::format("{} scores {} against {}: a population cannot grow in proportion to a negative "
                        "score; add the same to all payoffs",
                        excerpt(names_[i], 100), score(i, j), excerpt(names_[j], 100)));
}

std::optional<double> ScoreMatrix::cooperation(std::size_t i, std::size_t j) const {
  if (cooperations_.empty()) return std::nullopt;
  return cooperations_[behaviour_of_[i] * behaviours_ + behaviour_of_[j]] / weight_number_;
}

std::uint64_t ScoreMatrix::signature() const {
  Signature signature;
  signature.add(unit_.str());
  signature.add(weight_.str());
  for (std::size_t i = 0; i < size(); ++i) {
    signature.add(names_[i]);
    signature.add(static_cast<std::uint64_t>(behaviour_of_[i]));
  }
  for (const std::int64_t score : whole_) signature.add(static_cast<std::uint64_t>(score));
  return signature.value();
}

}  // namespace folk
