#include <folk/analysis/equilibria/continuation.h>
#include <folk/analysis/equilibria/examination.h>
#include <folk/analysis/equilibria/played_examination.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <utility>

namespace folk {
namespace {

/// Names the pair in what is refused.
template <class Work>
auto against(const ExaminationQuestion& question, const Strategy& opponent, Work work) {
  try {
    return work();
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{} against {}: {}", question.policy.name, opponent.name, error.what()));
  }
}

std::vector<PairExamination> examine_machine(const ExaminationQuestion& question, ClassReplies& beliefs,
                                             const Stages& stages) {
  std::vector<PairExamination> pairs;
  const Progress progress = begin_stage(stages, "checking pairs");
  const auto all = static_cast<double>(question.opponents.size());
  for (const Strategy& opponent : question.opponents) {
    const auto done = static_cast<double>(pairs.size());
    const Progress part = progress.part(done / all, (done + 1) / all);
    pairs.push_back(against(question, opponent, [&] {
      if (opponent.machine) return examine_machines(question, opponent, beliefs, part);
      auto records = record_beliefs(question.policy, {opponent}, question.sampling(), part);
      PairExamination pair = examine_record(question, opponent, std::move(records.front()), beliefs);
      judge_record(question, pair);
      return pair;
    }));
    part(1);
  }
  return pairs;
}

std::vector<PairExamination> examine_player(const ExaminationQuestion& question, ClassReplies& beliefs,
                                            const Stages& stages) {
  auto records =
      record_beliefs(question.policy, question.opponents, question.sampling(), begin_stage(stages, "playing"));
  std::vector<PairExamination> pairs;
  for (std::size_t i = 0; i < records.size(); ++i)
    pairs.push_back(against(question, question.opponents[i], [&] {
      return examine_record(question, question.opponents[i], std::move(records[i]), beliefs);
    }));
  add_known_replies(question, pairs);
  add_own_beliefs(question, pairs, begin_stage(stages, "searching on its own beliefs"));
  for (auto& pair : pairs) judge_record(question, pair);
  return pairs;
}

}  // namespace

void check_noise(const ExaminationQuestion& question) {
  if (question.noise == 0) return;
  if (question.noise == 1)
    throw UsageError("noise 1 turns every move over and leaves nothing to chance: expected less than 1");
  const auto check = [](const Strategy& strategy) {
    if (!strategy.machine)
      throw UsageError(fmt::format("{} is played, not enumerated: claims about it need noise 0", strategy.name));
  };
  check(question.policy);
  for (const Strategy& opponent : question.opponents) check(opponent);
}

Examination examine(const ExaminationQuestion& question, const Stages& stages) {
  check_noise(question);
  check_from(question);
  ClassReplies beliefs = class_replies(question);
  Examination examination;
  examination.pairs =
      question.policy.machine ? examine_machine(question, beliefs, stages) : examine_player(question, beliefs, stages);
  VerdictSummary summary;
  for (const auto& pair : examination.pairs) {
    summary.add(pair.verdicts, pair.opponent);
    if (!pair.belief) continue;
    if (examination.belief)
      *examination.belief += *pair.belief;
    else
      examination.belief = pair.belief;
  }
  examination.verdicts = summary.overall();
  examination.worst = summary.worst();
  return examination;
}

}  // namespace folk
