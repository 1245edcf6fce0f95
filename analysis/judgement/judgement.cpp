#include <folk/analysis/judgement/judgement.h>

namespace folk {
namespace {

SelfConfirmingReading reading_of(const std::vector<MatchJudgement>& matches) {
  SelfConfirmingReading reading;
  for (std::size_t m = 0; m < matches.size(); ++m) {
    const MatchJudgement& match = matches[m];
    const bool free = match.free_beliefs.gain == 0;
    const bool right = match.stated > 0 && match.right == match.stated;
    if (match.free_beliefs.gain > matches[reading.worst].free_beliefs.gain) reading.worst = m;
    reading.free += free ? 1 : 0;
    reading.agreed += match.class_beliefs ? 1 : 0;
    reading.of_class += match.class_beliefs && match.class_beliefs->gain == 0 ? 1 : 0;
    reading.stated += match.stated > 0 ? 1 : 0;
    reading.right += right ? 1 : 0;
    reading.all += right && free ? 1 : 0;
  }
  return reading;
}

}  // namespace

Judgement judge_play(const JudgementQuestion& question, const Progress& progress) {
  const auto& matches = question.play.matches;
  const std::uint64_t longest = question.play.longest_match();
  Judgement judgement;
  judgement.players = candidates_of(question.players, longest);
  judgement.opponents = candidates_of(question.opponents, longest);
  judgement.own =
      judge_own(judgement.players, matches, question.slips, question.payoffs, question.threads, progress.part(0, 0.3));
  judgement.matches = judge_matches(judgement.opponents, matches, question.slips, question.payoffs, question.threads,
                                    progress.part(0.3, 1));
  if (question.play.has_beliefs()) {
    judgement.beliefs.emplace();
    for (const auto& match : matches) judgement.beliefs->add(match.rounds);
    judgement.stage = stage_replies(matches, question.payoffs);
  }
  judgement.reading = reading_of(judgement.matches);
  return judgement;
}

}  // namespace folk
