#pragma once
// The whole answer to an examination's question: opponent by opponent, and in all.

#include <folk/analysis/beliefs/belief_consistency.h>
#include <folk/analysis/equilibria/examination_question.h>
#include <folk/analysis/equilibria/pair_examination.h>
#include <folk/analysis/equilibria/verdict_summary.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// What was found. The overall verdict of a notion is the worst of the opponents' (VerdictSummary).
struct Examination {
  std::vector<PairExamination> pairs;       ///< in the order of the opponents
  std::optional<BeliefConsistency> belief;  ///< of all of them
  Certificates verdicts{};
  std::array<std::string, all_notions.size()> worst{};  ///< the opponent that each verdict is about

  const std::optional<Certificate>& verdict(Notion notion) const { return verdicts[place_of(notion)]; }
};

/// Throws UsageError for what noise leaves without an answer: noise 1, and a policy or an opponent that is no machine,
/// whose moves slip in no match that could be enumerated. The first thing that `examine` does.
void check_noise(const ExaminationQuestion& question);

/// Examines each pair by the most exact way there is: two machines by pair_gaps and (without noise) thresholds,
/// whatever else by its matches (played_examination.h), which for a policy that is no machine include the replies of
/// others and, where it holds beliefs, a search on these. The answer depends on no number of threads. Throws UsageError
/// that names the pair for what cannot be examined, and for a pair that is not two machines under a criterion other
/// than finite:T; as check_from does; and what the players throw.
Examination examine(const ExaminationQuestion& question, const Stages& stages = nullptr);

}  // namespace folk
