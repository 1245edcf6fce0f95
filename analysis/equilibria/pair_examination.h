#pragma once
// What is found about a policy and one opponent, and the finding of it where both are machines.

#include <folk/analysis/beliefs/belief_consistency.h>
#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/beliefs/own_belief_gap.h>
#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/equilibria/examination_question.h>
#include <folk/analysis/equilibria/verdict_summary.h>
#include <folk/analysis/play/pair_result.h>
#include <folk/analysis/play/play_path.h>
#include <folk/analysis/replies/class_replies.h>
#include <folk/analysis/thresholds/thresholds.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// A situation that machines that mix or slip come into with positive probability.
struct InformationState {
  std::vector<Outcome> history;  ///< a shortest one that leads there
  double own = 1;                ///< P(C) of both, as they really play
  double theirs = 1;
};

/// Situations of machines that mix or slip are listed up to this many.
inline constexpr std::size_t most_listed_states = 1000;

/// The policy against one opponent. What does not apply, or is not known, is empty.
struct PairExamination {
  std::string opponent;
  std::vector<Outcome> before{};           ///< what is played before the round from which on is asked
  std::optional<PlayPath> path{};          ///< of a pair without chance, from that round on
  std::size_t all_states = 0;              ///< how many such situations there are; the first of them:
  std::vector<InformationState> states{};  ///< of machines that mix or slip
  double own_score = 0;                    ///< in the criterion's unit
  double their_score = 0;
  Method method = Method::cycle;              ///< how the scores were obtained
  std::optional<BeliefRecord> record{};       ///< of a pair that is not two machines
  std::optional<BeliefConsistency> belief{};  ///< of a policy that believes
  PairGaps gaps{};
  std::optional<Thresholds> thresholds{};    ///< of two deterministic finite machines, without noise
  std::optional<OwnBeliefGap> own_search{};  ///< self_confirming_own in detail
  Certificates verdicts{};
};

/// Puts the rounds that were really played before every history that was found: the deviations, and those that bind at
/// the ends of thresholds. They become what `found` says was played before.
void put_before(const std::vector<Outcome>& before, PairExamination& found);

/// The question of two machines, judged; scores, gains and thresholds are seen from question.from on. `beliefs` is
/// class_replies(question), kept over the question's pairs: the machines are prepared there. From a later round on each
/// pair has a class of its own, and they count for nothing.
/// Throws UsageError as PreparedPair and pair_gaps do, and as thresholds and play_pair do.
PairExamination examine_machines(const ExaminationQuestion& question, const Strategy& opponent, ClassReplies& beliefs,
                                 const Progress& progress = nullptr);

}  // namespace folk
