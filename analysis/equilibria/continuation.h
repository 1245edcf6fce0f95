#pragma once
// A pair from a later round on: two machines in the states where the rounds that were really played have left them.

#include <folk/analysis/equilibria/examination_question.h>
#include <folk/games/outcome.h>
#include <folk/strategies/machine.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace folk {

/// A machine that begins where this history (its own move first) leaves `machine`, whatever that would itself have
/// played.
std::shared_ptr<const Machine> machine_after(const std::shared_ptr<const Machine>& machine,
                                             const std::vector<Outcome>& history);

/// What is asked of a pair in the round after `before` (the policy's move first). Payoffs are seen from that round:
/// of finite:T the rounds that are left, of the other criteria the same. The machines of the class have been told what
/// was played, too, and are continued from there: they may be believed when they play as the other side does from that
/// round on, whatever they would have played before.
struct Continuation {
  ExaminationQuestion question;         ///< of the continued policy; `beliefs` are what it may hold the opponent to be
  Strategy opponent;                    ///< continued, where it is a machine
  std::vector<Strategy> their_beliefs;  ///< what the opponent may hold the policy to be

  Continuation(const ExaminationQuestion& asked, const Strategy& against, const std::vector<Outcome>& before);

  /// The question with the beliefs of the opponent.
  EquilibriumQuestion their_question() const;
};

/// Throws UsageError where what is played before a later round is random: under noise, and with strategies that draw.
void check_one_path(const ExaminationQuestion& question);

/// check_one_path where question.from is not 1. Throws UsageError for a round after the last of finite:T, and after
/// most_path_rounds, too.
void check_from(const ExaminationQuestion& question);

/// What two machines that do not mix play in their first rounds, the policy's move first.
std::vector<Outcome> first_rounds_of(const Machine& policy, const Machine& opponent, std::uint64_t rounds);

}  // namespace folk
