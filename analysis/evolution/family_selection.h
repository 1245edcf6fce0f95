#pragma once
// The random models of Mathieu & Delahaye's program, in which families (strategies with all their members) meet and
// grow.

#include <folk/analysis/evolution/dynamics.h>
#include <folk/analysis/evolution/score_matrix.h>

namespace folk {

/// The program's names (cristal-smac, evolutions.py at 40c86c7): EvolEncounter or M3, EvolMoran or M4, EvolFermi or M5.
enum class FamilyModel {
  encounter,  ///< two families drawn by their numbers
  moran,      ///< one is born by income, one dies by numbers
  fermi       ///< as encounter, the two drawn by income; there is no Fermi function in it, see pairwise comparison
};

/// With f_i = n_i sum_j n_j S_ij:
///   encounter, fermi: two families i and j are drawn, with weights n (encounter) or f (fermi); with replacement where
///     income is individual (i = j may be), without where it is communal. n_i += S_ij, n_j += S_ji; then all are scaled
///     back to the N of the start, n_k = trunc(N n_k / sum n), and the shortfall goes whole to one of the families that
///     are left, each as likely.
///   moran: n_w += 1 for a w drawn with weights f, n_l -= 1 for an l drawn with weights n, independently.
/// Where income is communal S_ii counts as 0 in f. Where nobody earns anything nothing changes.
class FamilySelection : public Dynamics {
public:
  /// The most individuals: sums of all products stay exact.
  static constexpr double most = 1e9;

  /// Throws UsageError on a negative score and a population outside 1 to `most`.
  FamilySelection(std::shared_ptr<const ScoreMatrix> scores, const Population& start, FamilyModel model,
                  Income income = Income::individual);

  void advance(Population& now, RandomStream& random) const override;
  bool is_random() const override { return true; }
  bool stays_uniform() const override { return true; }
  std::string text() const override;

private:
  std::vector<double> earned(const Population& now) const;
  void meet(Population& now, std::vector<double> weights, RandomStream& random) const;

  std::shared_ptr<const ScoreMatrix> scores_;
  double total_ = 0;
  FamilyModel model_;
  Income income_;
};

}  // namespace folk
