// Answers the question of sce-check: the library examines, and the transformer is asked whether its beliefs matter.

#include <folk/tools/sce_check/report.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <utility>

namespace folk::tools {
namespace {

/// Against whom an extracted automaton is put that was not built from them.
constexpr const char* unseen = "memory(1,1)";

void add_belief_effects(const SceQuestion& question, SceReport& report) {
  if (!question.mind || !question.mind->believes() || question.from > 1) return;  // it is of whole matches
  const auto& training = question.mind->policy.training;
  // The intervention is made in the matches that the policy was trained for.
  if (!(question.criterion == Criterion::finite(training.rounds)) || !(question.payoffs == training.payoffs)) return;
  const auto effects = sct::belief_effects(question.mind, question.opponents, question.threads);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    report.opponents[i].effect = effects[i];
    report.effect = report.effect.value_or(sct::BeliefEffect{}) += effects[i];
  }
}

}  // namespace

SceReport examine(const SceQuestion& question, const Stages& stages) {
  Examination found = folk::examine(question, stages);
  SceReport report;
  if (question.extract)
    report.extracted =
        extract_machine(question, found, Registry::standard().roster(unseen, question.payoffs), unseen, stages);
  for (PairExamination& pair : found.pairs) report.opponents.push_back({std::move(pair), std::nullopt});
  report.belief = std::move(found.belief);
  report.verdicts = std::move(found.verdicts);
  report.worst = std::move(found.worst);
  add_belief_effects(question, report);
  if (question.settled) report.settlement = settlement(question, stages);
  return report;
}

bool holds(const SceReport& report, const std::string& required) {
  const Notion notion = required == "nash"              ? Notion::nash
                        : required == "subgame-perfect" ? Notion::subgame_perfect
                        : required == "beliefs"         ? Notion::beliefs
                                                        : Notion::self_confirming_unrestricted;
  const auto& verdict = report.verdicts[place_of(notion)];
  if (!verdict) throw UsageError(fmt::format("--require {}: it does not apply here, nothing is known of it", required));
  if (report.settlement) {
    const auto& settled = report.settlement->all[place_of(notion)];
    return settled && settled->from;
  }
  return verdict->verdict != Verdict::refuted;
}

}  // namespace folk::tools
