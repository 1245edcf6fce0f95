#pragma once
// The discrete replicator equation: shares of an infinite population that grow in proportion to what they earn.

#include <folk/analysis/evolution/dynamics.h>
#include <folk/analysis/evolution/score_matrix.h>

namespace folk {

struct ReplicatorSettings {
  Income income = Income::individual;
  double resilience = 0;    ///< rho: this share of each strategy stays as it is, 0 <= rho < 1
  double mutation = 0;      ///< mu: this share of the offspring are of another strategy, each of the others alike
  double tolerance = 1e-5;  ///< changes of no share by more than this count as none
};

/// p_i' = rho p_i + (1 - rho) sum_j Q_ji p_j f_j / phi, f_j = sum_k p_k S_jk, phi = sum_j p_j f_j, with 0 for S_jj
/// where income is communal; Q_jj = 1 - mu, Q_ji = mu / (k - 1) for k strategies. Without mutation the discrete
/// replicator equation (Taylor & Jonker 1978; Hofbauer & Sigmund 1998, 7.1) and EvolDeterReal of the program of Mathieu
/// & Delahaye (cristal-smac at 40c86c7); with it the replicator-mutator equation (Page & Nowak 2002). Where nobody
/// earns anything nothing changes.
class Replicator : public Dynamics {
public:
  /// Throws UsageError on a negative score and parameters out of range.
  Replicator(std::shared_ptr<const ScoreMatrix> scores, const ReplicatorSettings& settings = {});

  void advance(Population& now, RandomStream&) const override;
  bool is_random() const override { return false; }
  bool has_shares() const override { return true; }
  bool stays_uniform() const override { return settings_.mutation == 0; }
  double tolerance() const override { return settings_.tolerance; }
  std::string text() const override;

private:
  std::shared_ptr<const ScoreMatrix> scores_;
  ReplicatorSettings settings_;
};

}  // namespace folk
