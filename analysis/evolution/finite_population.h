#pragma once
// A finite population in which one individual at a time is replaced: birth-death and pairwise comparison, step by step.

#include <folk/analysis/evolution/dynamics.h>
#include <folk/analysis/evolution/score_matrix.h>
#include <folk/analysis/evolution/selection_rules.h>

namespace folk {

/// One event a generation: by `rules`, where the newcomer is of another strategy with probability `mutation`, each of
/// the others alike.
class FinitePopulation : public Dynamics {
public:
  static constexpr double most = 1e9;

  /// Throws UsageError on rules, mutation or a population (2 to `most`) out of range, and where linear fitness can be
  /// negative.
  FinitePopulation(std::shared_ptr<const ScoreMatrix> scores, const Population& start, const SelectionRules& rules,
                   double mutation = 0);

  void advance(Population& now, RandomStream& random) const override;
  bool is_random() const override { return true; }
  bool stays_uniform() const override { return mutation_ == 0; }
  std::string text() const override;

private:
  double against(std::size_t i, std::size_t j) const {
    return payoffs_[scores_->behaviour(i) * scores_->behaviours() + scores_->behaviour(j)];
  }
  double payoff(const Population& now, std::size_t i) const;
  std::size_t newcomer(std::size_t strategy, RandomStream& random) const;

  std::shared_ptr<const ScoreMatrix> scores_;
  std::vector<double> payoffs_;  // by behaviour, row against column
  SelectionRules rules_;
  double total_ = 0;
  double intensity_ = 0;
  double mutation_ = 0;
};

/// Throws UsageError where 1 - w + w payoff may be negative for some payoff of the matrix.
void require_fitness(const ScoreMatrix& scores, const SelectionRules& rules);

}  // namespace folk
