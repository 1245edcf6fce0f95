#pragma once
// What can be said of a policy that can only be played: from the matches, from its beliefs, and from what others earn.

#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/equilibria/examination_question.h>
#include <folk/analysis/equilibria/pair_examination.h>
#include <folk/analysis/replies/class_replies.h>

#include <functional>
#include <vector>

namespace folk {

/// What the matches of a record pay, totals of a match on average.
struct MatchScores {
  double own = 0;
  double theirs = 0;
  double error = 0;  ///< bernstein_bound of `own` that fails once in a million times
};

/// Throws std::logic_error for a record without matches.
MatchScores match_scores(const BeliefRecord& record, const Payoffs& payoffs);

/// The question of a pair that is not two machines, from its matches under finite:T; not judged yet.
///
/// Where both are deterministic the one match is the path, and what match_gaps can say of it is exact. Sampled matches
/// against a machine tell what its best reply gains over the policy's mean: a lower bound whose residual holds the
/// sampling error, so that it can refute and never certify. `beliefs` is class_replies(question). From a later round
/// than the first on (which wants one path) scores, gains and beliefs are those from question.from on; the record that
/// is kept has the whole match, without the beliefs before.
/// Throws UsageError as match_gaps and best_reply do, and std::logic_error for a record without matches.
PairExamination examine_record(const ExaminationQuestion& question, const Strategy& opponent, BeliefRecord record,
                               ClassReplies& beliefs);

/// The matches of the policy with those of question.imitated that are not among `records`; none where no record is of
/// one path. Throws what record_beliefs throws.
std::vector<BeliefRecord> imitated_records(const ExaminationQuestion& question,
                                           const std::vector<BeliefRecord>& records);

/// Nobody can enumerate a policy that is no machine, but what others earn against it is known: a reply that each of its
/// opponents could copy. Adds, as a lower bound, what the best of `records` (whole matches) earns more than each
/// opponent from question.from on; of those who played as it did before that round. Sampled pairs count for nothing.
void add_known_replies(const ExaminationQuestion& question, const std::vector<BeliefRecord>& records,
                       std::vector<PairExamination>& pairs);

/// The same with the records of `pairs`, examined by examine_record, and imitated_records. Throws as that does.
void add_known_replies(const ExaminationQuestion& question, std::vector<PairExamination>& pairs);

/// What the policy could gain if the world were as it believes (own_belief_gaps), for the pairs with one path.
/// Throws what own_belief_gaps throws.
void add_own_beliefs(const ExaminationQuestion& question, std::vector<PairExamination>& pairs,
                     const Progress& progress = nullptr);

/// Judges every notion; beliefs where the policy holds any.
void judge_record(const ExaminationQuestion& question, PairExamination& pair);

}  // namespace folk
