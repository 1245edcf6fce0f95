#pragma once
// What ipd-judge found, in words and numbers that text and page share.

#include <folk/tools/ipd_judge/question.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// "1 round", "2 matches": the plural where there is not one.
std::string counted(std::uint64_t number, const std::string& one, const std::string& several);

/// "every strategy weighs 1 ...": what was taken to be likely before.
std::string prior_words(const JudgeQuestion& question);

/// "0.02"; and how likely each slip rate is that is worth a word: "0.02 (61 %), 0.035 (20 %)".
std::string slip_words(const JudgeQuestion& question, const Judgement& found);

/// The name of a candidate: a behaviour's strategies, or a class.
std::string name_of(const Candidates& candidates, std::size_t candidate);

/// "2^26", "3", "0": members of a class; powers of 2 as such from 2^31 on.
std::string members_text(const Integer& members);

/// "match 3, round 5"; "-" for nothing.
std::string place_text(const std::vector<MatchJudgement>& matches, const std::optional<RecordedPlace>& place);

/// The strategies that could have made every move, in the order of the SPEC.
std::vector<std::string> names_that_agree(const Judgement& found);

/// These in a phrase, the first `most` by name.
std::string agreement_words(const Judgement& found, std::size_t most);

/// What agrees of a class, in a sentence.
std::string class_words(const ClassAgreement& agreement);

/// "tit_for_tat, spiteful and 3 more"; "-" for nobody.
std::string met_words(const Judgement& found, const MatchJudgement& match);

/// "gtft(1/3) (61.23 %, slip 0.02)"; "-" where the match is impossible.
std::string likeliest_words(const Judgement& found, const MatchJudgement& match);

/// "2", "2 to 8", "about 1.5" where it is expected, "-" where it is unknown.
std::string regret_text(const MatchJudgement& match);

/// The regrets of all matches together: to whichever opponents that agree it is least, and to which it is largest.
struct RegretSum {
  double least = 0;
  double largest = 0;
  std::size_t matches = 0;  ///< in which a regret is known
};
RegretSum regret_sum(const Judgement& found);

/// "12 to 40 over 30 matches".
std::string regret_words(const Judgement& found);

/// How stated beliefs scored, and how the moves stand to them.
std::string belief_words(const BeliefConsistency& beliefs);
std::string stage_words(const StageReplies& stage);

/// "20 to 30 %" of the bin in place 2.
std::string bin_text(std::size_t bin);

/// A candidate as tables and CSV have it.
struct CandidateRow {
  std::size_t candidate = 0;  ///< behaviours in their order, then classes
  std::size_t rank = 1;       ///< as many are likelier, and one: who is as likely shares it
  std::string name;
  double weight = 0;
  double posterior = 0;
  double slip = 0;              ///< that goes with it best
  std::uint64_t otherwise = 0;  ///< moves that it never makes there; of a class those of its nearest members
  std::string first_otherwise;
};

/// All candidates, the likeliest first.
std::vector<CandidateRow> candidate_rows(const JudgeQuestion& question, const Judgement& found);

/// What a reading as self-confirming play needs, a line each: what, and what was found.
struct Need {
  std::string what;
  bool holds = false;
  std::string found;
};
std::vector<Need> needs_of(const Judgement& found);

}  // namespace folk::tools
