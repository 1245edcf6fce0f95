#include <folk/analysis/evolution/integer_selection.h>
#include <folk/games/error.h>
#include <folk/games/int128.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk {
namespace {

double as_double(Int128 value) { return static_cast<double>(value); }
double as_double(const Integer& value) { return to_double(value); }

}  // namespace

IntegerSelection::IntegerSelection(std::shared_ptr<const ScoreMatrix> scores, const Population& start,
                                   const IntegerSelectionSettings& settings, bool keeps_last)
    : scores_(std::move(scores)),
      settings_(settings),
      keeps_last_(keeps_last) {
  scores_->require_no_negative_score();
  if (settings.resilience < 0 || settings.resilience >= 1)
    throw UsageError("resilience: expected a number from 0 up to but not 1");
  if (!settings.resilience.denominator().fits_word())
    throw UsageError("resilience: expected a fraction of at most 18 digits");
  for (const double number : start) total_ += number;
  if (!(total_ > 0 && total_ <= most_individuals))
    throw UsageError(fmt::format("a population of {} individuals: expected 1 to 10^15", total_));
  double largest = 1;
  for (std::size_t a = 0; a < scores_->behaviours(); ++a)
    for (std::size_t b = 0; b < scores_->behaviours(); ++b)
      largest = std::max(largest, static_cast<double>(scores_->whole(a, b)));
  const double denominator = to_double(settings.resilience.denominator());
  // The largest number on the way is N n_i f_i times the numerator of 1 - rho.
  narrow_ = 3 * std::log2(total_) + std::log2(largest) + 2 * std::log2(denominator) < 125;
}

std::string IntegerSelection::text() const {
  if (!keeps_last_) return "ecological competition";
  return fmt::format("integer selection, income {}, {}, resilience {}", to_string(settings_.income),
                     settings_.meets_itself ? "meets itself" : "does not meet itself",
                     to_short_text(settings_.resilience));
}

template <class Number>
void IntegerSelection::advance_in(Population& now) const {
  const std::size_t n = now.size();
  // Those that behave alike earn alike: what is added up are behaviours that still live.
  std::vector<Number> members(scores_->behaviours(), 0);
  for (std::size_t i = 0; i < n; ++i) members[scores_->behaviour(i)] += static_cast<std::int64_t>(now[i]);
  std::vector<std::size_t> present;
  for (std::size_t b = 0; b < members.size(); ++b)
    if (members[b] > 0) present.push_back(b);
  std::vector<Number> income(members.size(), 0);
  for (const std::size_t a : present)
    for (const std::size_t b : present) income[a] += members[b] * Number(scores_->whole(a, b));
  std::vector<Number> earned(n, 0);  // n_i f_i
  Number all = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(now[i] > 0)) continue;
    const std::size_t a = scores_->behaviour(i);
    const auto number = static_cast<std::int64_t>(now[i]);
    const Number own(scores_->whole(a, a));
    Number each = income[a];
    if (settings_.income == Income::communal)
      each -= Number(number) * own;
    else if (!settings_.meets_itself)
      each -= own;
    earned[i] = Number(number) * each;
    all += earned[i];
  }
  if (!(all > 0)) return;
  const Number above(settings_.resilience.numerator().word());
  const Number below(settings_.resilience.denominator().word());
  const Number total(static_cast<std::int64_t>(total_));
  for (std::size_t i = 0; i < n; ++i) {
    if (!(now[i] > 0)) continue;
    const Number stays = above * Number(static_cast<std::int64_t>(now[i])) / below;
    const Number grown = (below - above) * total * earned[i] / (below * all);
    now[i] = as_double(Number(stays + grown));
  }
}

void IntegerSelection::advance(Population& now, RandomStream&) const {
  if (keeps_last_ && living(now) <= 1) return;
  if (narrow_)
    advance_in<Int128>(now);
  else
    advance_in<Integer>(now);
}

}  // namespace folk
