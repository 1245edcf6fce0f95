#pragma once
// The machines that a side may hold its opponent to be, and the best reply to each.

#include <folk/analysis/replies/best_reply.h>
#include <folk/analysis/replies/prepared_machine.h>
#include <folk/games/match_rules.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <vector>

namespace folk {

/// A class of beliefs under the rules of one question. Replies are found when they are first asked for, and kept:
/// whoever checks many pairs hands the same object to all of them. Not for several threads at once.
class ClassReplies {
public:
  /// Machines without end are followed for `horizon` rounds under criteria without end; 0 stands for 100 rounds.
  ClassReplies(std::vector<Strategy> members, const MatchRules& rules, unsigned horizon = 0);

  const std::vector<Strategy>& members() const { return members_; }
  const MatchRules& rules() const { return machines_.rules(); }
  const Payoffs& payoffs() const { return rules().payoffs; }
  const Criterion& criterion() const { return rules().criterion; }
  unsigned horizon() const { return horizon_; }

  /// True for a machine that has no end under a criterion that has none: its figures are bounds.
  bool endless(std::size_t member) const;

  /// The best reply to a member that is a machine. Throws UsageError as best_reply does.
  const BestReply& reply(std::size_t member);

  /// Such a member as a table, as PreparedMachine::table has it. Throws UsageError as table_for does.
  const Automaton& table(std::size_t member);

  /// Where the members were prepared: a machine that is also played comes from here and is prepared only once.
  PreparedMachines& machines() { return machines_; }

private:
  std::vector<Strategy> members_;
  unsigned horizon_;
  PreparedMachines machines_;
};

}  // namespace folk
