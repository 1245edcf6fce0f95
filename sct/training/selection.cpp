#include <folk/sct/training/selection.h>

#include <algorithm>

namespace folk::sct {

const TargetScore& best_target(const Evaluation& evaluation) {
  return *std::min_element(evaluation.scores.begin(), evaluation.scores.end(), [](const auto& a, const auto& b) {
    return a.total != b.total ? a.total > b.total : a.target < b.target;
  });
}

bool takes_over(const Evaluation& later, const Evaluation& kept) {
  return best_target(later).total >= best_target(kept).total;
}

}  // namespace folk::sct
