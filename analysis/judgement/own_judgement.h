#pragma once
// Who the recorded player may be: the strategies that agree with all its moves, and the likeliest when moves slip.

#include <folk/analysis/judgement/agreement.h>
#include <folk/analysis/judgement/candidates.h>
#include <folk/analysis/judgement/class_agreement.h>
#include <folk/analysis/judgement/slip_posterior.h>
#include <folk/games/progress.h>

#include <cstddef>
#include <vector>

namespace folk {

/// Candidates are told by their place: behaviours in their order, then classes.
struct OwnJudgement {
  std::vector<Agreement> agreements;  ///< a behaviour each
  std::vector<ClassAgreement> class_agreements;
  SlipPosterior posterior;

  /// Strategies that could have made every move without a slip: their behaviours, in order.
  std::vector<std::size_t> consistent() const;

  /// All candidates, the likeliest first; of several as likely the earlier one.
  std::vector<std::size_t> ranking() const;
};

/// One player is taken to have played all of `matches` by one strategy, begun anew in each. `slips` as check_slips
/// wants them. The answer depends on no number of threads. Throws as agreement_with does, and Cancelled.
OwnJudgement judge_own(const Candidates& candidates, const std::vector<RecordedMatch>& matches,
                       const std::vector<double>& slips, const Payoffs& payoffs, unsigned threads,
                       const Progress& progress = nullptr);

/// The posterior of candidates with these agreements.
SlipPosterior posterior_of(const Candidates& candidates, const std::vector<Agreement>& agreements,
                           const std::vector<ClassAgreement>& class_agreements, const std::vector<double>& slips);

}  // namespace folk
