#pragma once
// What sce-check found.

#include <folk/games/outcome.h>
#include <folk/tools/sce_check/question.h>

#include <folk/analysis/beliefs/belief_consistency.h>
#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/beliefs/extraction.h>
#include <folk/analysis/beliefs/own_belief_gap.h>
#include <folk/analysis/equilibria/certificate.h>
#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/play/pair_result.h>
#include <folk/analysis/thresholds/thresholds.h>
#include <folk/sct/policy/belief_effect.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// Judgements by notion; nothing where a notion does not apply.
using Verdicts = std::array<std::optional<Certificate>, all_notions.size()>;

/// A situation that machines that mix come into with positive probability.
struct InformationState {
  std::vector<Outcome> history;  ///< a shortest one that leads there
  double own = 1;                ///< P(C) of both
  double theirs = 1;
};

/// The policy against one opponent.
struct OpponentReport {
  std::string opponent;
  std::optional<PlayPath> path;            ///< of a pair without chance
  std::size_t all_states = 0;              ///< how many such situations there are; the first of them:
  std::vector<InformationState> states{};  ///< of machines that mix
  double own_score = 0;                    ///< in the criterion's unit
  double their_score = 0;
  Method method = Method::cycle;              ///< how the scores were obtained
  std::optional<BeliefRecord> record{};       ///< of a policy that is no machine
  std::optional<BeliefConsistency> belief{};  ///< of a policy that believes
  PairGaps gaps{};
  std::optional<Thresholds> thresholds{};     ///< of two deterministic finite machines
  std::optional<OwnBeliefGap> own_search{};   ///< notion (c) in detail
  std::optional<sct::BeliefEffect> effect{};  ///< of a transformer
  Verdicts verdicts{};
};

/// An automaton that plays as the policy does.
struct ExtractedMachine {
  std::vector<Extraction> tried;
  std::size_t chosen = 0;
  Fidelity unseen;          ///< against opponents it was not built from
  std::string unseen_name;  ///< who they were
};

/// The whole answer. The overall verdict of a notion is the worst of the opponents'; `worst` names that opponent.
struct SceReport {
  std::vector<OpponentReport> opponents;
  std::optional<BeliefConsistency> belief;
  std::optional<sct::BeliefEffect> effect;
  Verdicts verdicts{};
  std::array<std::string, all_notions.size()> worst{};
  std::optional<ExtractedMachine> extracted;
};

/// Answers the question. `progress` is told what is done and the finished share of it.
SceReport examine(const SceQuestion& question,
                  const std::function<std::function<void(double)>(const std::string& stage)>& progress);

/// False when what was required is refuted.
bool holds(const SceReport& report, const std::string& required);

}  // namespace folk::tools
