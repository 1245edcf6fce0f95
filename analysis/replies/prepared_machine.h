#pragma once
// A machine made ready for a question: its tables, its smallest forms and the best reply to it, each made only once.

#include <folk/analysis/replies/best_reply.h>
#include <folk/games/match_rules.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/machine.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace folk {

/// What the rules of a question ask of a machine. Everything is made when it is first asked for, and kept, a refusal
/// too: asking again throws the same. Not for several threads at once.
class PreparedMachine {
public:
  PreparedMachine(std::shared_ptr<const Machine> machine, const MatchRules& rules);

  const Machine& machine() const { return *machine_; }
  const MatchRules& rules() const { return rules_; }
  const Criterion& criterion() const { return rules_.criterion; }

  /// True for a machine that has no end under a criterion that has none: its figures are bounds.
  bool endless() const { return !criterion().is_finite() && !machine_->finite(); }

  /// The machine as table_for makes it, in the sense own_moves_its_own (any_own_moves where there is noise); `horizon`
  /// counts where it is endless.
  /// Throws UsageError as table_for does.
  const Automaton& table(unsigned horizon = 0);

  /// The smallest automaton that answers alike over every history that the criterion lets happen, whoever deviated.
  /// Throws UsageError as table_for does without a horizon.
  const Automaton& minimal();

  /// The same over every history, whatever the criterion; null for a machine without end, or of more than 2^20 states.
  const Automaton* whole();

  /// A machine that plays as it does: the smallest where `table` is all of it, else itself.
  /// Throws UsageError as `table` does for a machine that is not endless.
  std::shared_ptr<const Machine> player(unsigned horizon = 0);

  /// The best reply to it, in the criterion's unit. Throws UsageError as best_reply does.
  const BestReply& reply(unsigned horizon = 0);

private:
  Sense sense() const;

  std::shared_ptr<const Machine> machine_;
  MatchRules rules_;
  std::map<unsigned, Automaton> tables_;  // by horizon; 0 where none counts
  std::map<unsigned, BestReply> replies_;
  std::optional<Automaton> minimal_;
  std::optional<std::string> refusal_;  // why there is no minimal_
  std::optional<std::optional<Automaton>> whole_;
  std::shared_ptr<const Machine> player_;
};

/// The machines of a question, each of them prepared once however often it comes up.
class PreparedMachines {
public:
  explicit PreparedMachines(const MatchRules& rules)
      : rules_(rules) {}

  const MatchRules& rules() const { return rules_; }

  /// The same machine (by address, which is kept alive) is the same entry.
  PreparedMachine& of(const std::shared_ptr<const Machine>& machine);

private:
  MatchRules rules_;
  std::map<const Machine*, std::unique_ptr<PreparedMachine>> machines_;
};

}  // namespace folk
