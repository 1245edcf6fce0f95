#pragma once
// Ecological competition: whole numbers of each strategy that grow in proportion to what they earn.

#include <folk/analysis/evolution/dynamics.h>
#include <folk/analysis/evolution/score_matrix.h>

namespace folk {

struct IntegerSelectionSettings {
  Income income = Income::individual;
  bool meets_itself = false;  ///< an individual also meets itself
  Rational resilience = 0;    ///< rho: this share of each strategy stays as it is, 0 <= rho < 1
};

/// n_i' = floor(rho n_i) + floor((1 - rho) N n_i f_i / sum_k n_k f_k), N being the total at the start, where
///   f_i = sum_j n_j S_ij - S_ii                      what an individual earns against all others,
///   f_i = sum_j n_j S_ij                             meets_itself,
/// with 0 for S_ii where income is communal. In exact integers of whatever size, so that floors are floors. What
/// floors leave over is lost: the total never grows beyond N. Where nobody earns anything nothing changes.
///
/// With the default settings this is the ecological competition of Beaufils, Delahaye & Mathieu (Artificial Life V,
/// 1996) as the program of Mathieu & Delahaye (cristal-smac/ipd at 40c86c7, class Ecological) computes it; the others
/// are its EvolDeterInt, in which a population of a single strategy stays as it is (`keeps_last`).
class IntegerSelection : public Dynamics {
public:
  /// Throws UsageError on a negative score, a resilience outside [0, 1) and more than most_individuals.
  IntegerSelection(std::shared_ptr<const ScoreMatrix> scores, const Population& start,
                   const IntegerSelectionSettings& settings = {}, bool keeps_last = false);

  void advance(Population& now, RandomStream&) const override;
  bool is_random() const override { return false; }
  bool stays_uniform() const override { return keeps_last_; }
  std::string text() const override;

private:
  template <class Number>
  void advance_in(Population& now) const;

  std::shared_ptr<const ScoreMatrix> scores_;
  IntegerSelectionSettings settings_;
  double total_ = 0;
  bool keeps_last_;
  bool narrow_ = false;  // 127 bits are enough
};

}  // namespace folk
