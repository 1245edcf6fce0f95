#include <folk/analysis/evolution/family_selection.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk {

FamilySelection::FamilySelection(std::shared_ptr<const ScoreMatrix> scores, const Population& start, FamilyModel model,
                                 Income income)
    : scores_(std::move(scores)),
      model_(model),
      income_(income) {
  scores_->require_no_negative_score();
  for (const double number : start) total_ += number;
  if (!(total_ >= 1 && total_ <= most))
    throw UsageError(fmt::format("a population of {} individuals: expected 1 to 10^9 for a random model", total_));
}

std::string FamilySelection::text() const {
  const char* const name = model_ == FamilyModel::encounter ? "encounters"
                           : model_ == FamilyModel::moran   ? "Moran by income"
                                                            : "encounters by income";
  return fmt::format("{}, income {}", name, to_string(income_));
}

std::vector<double> FamilySelection::earned(const Population& now) const {
  std::vector<std::size_t> present;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] > 0) present.push_back(i);
  std::vector<double> all(now.size(), 0);
  for (const std::size_t i : present) {
    double each = 0;
    for (const std::size_t j : present)
      if (i != j || income_ == Income::individual) each += now[j] * scores_->score(i, j);
    all[i] = now[i] * each;
  }
  return all;
}

void FamilySelection::meet(Population& now, std::vector<double> weights, RandomStream& random) const {
  const std::size_t i = drawn_by(weights, random);
  if (income_ == Income::communal) weights[i] = 0;
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return !(weight > 0); })) return;
  const std::size_t j = drawn_by(weights, random);
  now[i] += scores_->score(i, j);
  now[j] += scores_->score(j, i);
  long double sum = 0;
  for (const double number : now) sum += static_cast<long double>(number);
  double left = total_;
  for (double& number : now) {
    number = static_cast<double>(std::floor(static_cast<long double>(total_) * static_cast<long double>(number) / sum));
    left -= number;
  }
  if (left > 0) {
    std::vector<double> families(now.size(), 0);
    for (std::size_t k = 0; k < now.size(); ++k) families[k] = now[k] > 0 ? 1 : 0;
    if (living(families) > 0) now[drawn_by(families, random)] += left;
  }
}

void FamilySelection::advance(Population& now, RandomStream& random) const {
  if (living(now) <= 1) return;
  const auto weights = model_ == FamilyModel::encounter ? std::vector<double>(now) : earned(now);
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return !(weight > 0); })) return;
  if (model_ != FamilyModel::moran) {
    meet(now, weights, random);
    return;
  }
  const std::size_t born = drawn_by(weights, random);
  const std::size_t dead = drawn_by(now, random);
  now[born] += 1;
  now[dead] -= 1;
}

}  // namespace folk
