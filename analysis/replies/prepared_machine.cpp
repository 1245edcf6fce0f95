#include <folk/analysis/play/criterion_table.h>
#include <folk/analysis/replies/prepared_machine.h>
#include <folk/games/error.h>

namespace folk {
namespace {

/// Under another horizon it would be another table.
bool is_cut(const Automaton& table, const PreparedMachine& prepared) {
  return prepared.endless() || (!prepared.criterion().is_finite() && table.beyond());
}

}  // namespace

PreparedMachine::PreparedMachine(std::shared_ptr<const Machine> machine, const MatchRules& rules)
    : machine_(std::move(machine)),
      rules_(rules) {}

Sense PreparedMachine::sense() const { return rules_.noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own; }

const Automaton& PreparedMachine::table(unsigned horizon) {
  for (const unsigned known : {0U, horizon})
    if (const auto place = tables_.find(known); place != tables_.end()) return place->second;
  Automaton table = table_for(*machine_, criterion(), sense(), horizon);
  const unsigned key = is_cut(table, *this) ? horizon : 0;
  return tables_.emplace(key, std::move(table)).first->second;
}

const Automaton& PreparedMachine::minimal() {
  if (refusal_) throw UsageError(*refusal_);
  try {
    if (!minimal_)
      minimal_ = minimise(table_for(*machine_, criterion(), Sense::any_own_moves, 0), Sense::any_own_moves);
  } catch (const UsageError& error) {
    refusal_ = error.what();
    throw;
  }
  return *minimal_;
}

const Automaton* PreparedMachine::whole() {
  if (!machine_->finite()) return nullptr;
  if (minimal_ && !minimal_->beyond()) return &*minimal_;
  if (!whole_) {
    const auto table = tabulate(*machine_, Sense::any_own_moves);
    whole_ = table ? std::optional(minimise(*table, Sense::any_own_moves)) : std::nullopt;
  }
  return *whole_ ? &**whole_ : nullptr;
}

std::shared_ptr<const Machine> PreparedMachine::player(unsigned horizon) {
  if (player_) return player_;
  player_ = machine_;
  if (machine_->finite())
    if (const Automaton& all = table(horizon); !all.beyond())
      player_ = std::make_shared<const Automaton>(minimise(all, sense()));
  return player_;
}

const BestReply& PreparedMachine::reply(unsigned horizon) {
  for (const unsigned known : {0U, horizon})
    if (const auto place = replies_.find(known); place != replies_.end()) return place->second;
  const Automaton& opponent = table(horizon);
  const unsigned key = is_cut(opponent, *this) ? horizon : 0;
  return replies_.emplace(key, best_reply_to_table(opponent, rules_, horizon)).first->second;
}

PreparedMachine& PreparedMachines::of(const std::shared_ptr<const Machine>& machine) {
  auto& prepared = machines_[machine.get()];
  if (!prepared) prepared = std::make_unique<PreparedMachine>(machine, rules_);
  return *prepared;
}

}  // namespace folk
