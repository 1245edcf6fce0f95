#pragma once
// What sce-check found.

#include <folk/tools/sce_check/question.h>

#include <folk/analysis/beliefs/belief_consistency.h>
#include <folk/analysis/equilibria/examination.h>
#include <folk/analysis/equilibria/extracted_machine.h>
#include <folk/analysis/equilibria/settlement.h>
#include <folk/sct/policy/belief_effect.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// The policy against one opponent.
struct OpponentReport : PairExamination {
  std::optional<sct::BeliefEffect> effect{};  ///< of a transformer
};

/// The whole answer. The overall verdict of a notion is the worst of the opponents'; `worst` names that opponent.
struct SceReport {
  std::vector<OpponentReport> opponents;
  std::optional<BeliefConsistency> belief;
  std::optional<sct::BeliefEffect> effect;
  Certificates verdicts{};
  std::array<std::string, all_notions.size()> worst{};
  std::optional<Settlement> settlement;  ///< where it was asked for
  std::optional<ExtractedMachine> extracted;
};

/// Answers the question: the library's examination, and what only a transformer can tell of itself.
SceReport examine(const SceQuestion& question, const Stages& stages);

/// False when what was required is refuted; where it was asked from which round on all holds, when there is none.
bool holds(const SceReport& report, const std::string& required);

}  // namespace folk::tools
