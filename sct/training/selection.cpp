#include <folk/sct/training/selection.h>

#include <algorithm>

namespace folk::sct {

const TargetScore& best_target(const Evaluation& evaluation) {
  return *std::min_element(evaluation.scores.begin(), evaluation.scores.end(), [](const auto& a, const auto& b) {
    return a.figure() != b.figure() ? a.figure() > b.figure() : a.target < b.target;
  });
}

bool takes_over(const Evaluation& later, const Evaluation& kept) {
  return best_target(later).figure() >= best_target(kept).figure();
}

std::optional<std::size_t> end_of_patience(const std::vector<Evaluation>& history, std::uint64_t patience) {
  if (patience == 0) return std::nullopt;
  std::size_t highest = 0;  // the first with the highest figure so far
  for (std::size_t i = 1; i < history.size(); ++i) {
    if (best_target(history[i]).figure() > best_target(history[highest]).figure()) highest = i;
    if (i - highest >= patience) return i;
  }
  return std::nullopt;
}

}  // namespace folk::sct
