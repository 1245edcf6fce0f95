#include <folk/analysis/play/criterion_table.h>
#include <folk/analysis/replies/prepared_machine.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

/// Counts how often somebody goes through all of it.
class Counted final : public Machine {
public:
  explicit Counted(Automaton machine)
      : machine_(std::move(machine)) {}

  State start() const override {
    ++begun;
    return machine_.start();
  }
  double cooperation(State state) const override { return machine_.cooperation(state); }
  State next(State state, Move own, Move theirs) const override { return machine_.next(state, own, theirs); }
  bool deterministic() const override { return machine_.deterministic(); }

  mutable int begun = 0;

private:
  Automaton machine_;
};

TEST(PreparedMachine, HoldsWhatTheSlowWaysGive) {
  const Registry registry = Registry::standard();
  for (const char* criterion : {"discounted:0.7", "ending:0.1", "finite:3", "finite:50"})
    for (const char* name : {"pavlov", "tf2t", "gradual", "random(0.5)"}) {
      const auto machine = registry.make(name).machine;
      const Criterion rule = Criterion::parse(criterion);
      PreparedMachine prepared(machine, {{}, rule});
      EXPECT_EQ(prepared.endless(), !rule.is_finite() && !machine->finite());
      EXPECT_EQ(prepared.table(20), table_for(*machine, rule, Sense::own_moves_its_own, 20)) << name << criterion;
      const BestReply fresh = best_reply(*machine, {{}, rule}, 20);
      const BestReply& kept = prepared.reply(20);
      EXPECT_EQ(kept.payoff, fresh.payoff) << name << criterion;
      EXPECT_EQ(kept.exact, fresh.exact) << name << criterion;
      EXPECT_EQ(kept.residual, fresh.residual) << name << criterion;
      EXPECT_EQ(kept.horizon, fresh.horizon) << name << criterion;
      EXPECT_EQ(kept.machine, fresh.machine) << name << criterion;
      if (!prepared.endless()) {
        EXPECT_EQ(prepared.minimal(),
                  minimise(table_for(*machine, rule, Sense::any_own_moves, 0), Sense::any_own_moves));
      }
    }
}

TEST(PreparedMachine, GoesThroughTheMachineOnceForEachSense) {
  const auto counted =
      std::make_shared<Counted>(*tabulate(*Registry::standard().make("pavlov").machine, Sense::any_own_moves));
  PreparedMachine prepared(counted, {{}, Criterion::discounted(0.7)});
  for (int time = 0; time < 3; ++time) {
    prepared.table();
    prepared.reply(10);  // no horizon counts for a finite machine
    prepared.reply(20);
    prepared.player();
  }
  EXPECT_EQ(counted->begun, 1);
  for (int time = 0; time < 3; ++time) {
    prepared.minimal();
    prepared.whole();
  }
  EXPECT_EQ(counted->begun, 2);
}

TEST(PreparedMachine, KeepsAHorizonApartWhereItCounts) {
  PreparedMachine gradual(Registry::standard().make("gradual").machine, {{}, Criterion::discounted(0.9)});
  EXPECT_EQ(gradual.reply(10).horizon, 10U);
  EXPECT_EQ(gradual.reply(20).horizon, 20U);
  EXPECT_EQ(gradual.reply(10).horizon, 10U);
  EXPECT_LT(gradual.table(10).size(), gradual.table(20).size());
  EXPECT_THROW(gradual.table(), UsageError);
  EXPECT_THROW(gradual.reply(), UsageError);
}

TEST(PreparedMachine, IsWholeWhateverTheCriterion) {
  const Registry registry = Registry::standard();
  const auto three_states = registry.make("per_ccd").machine;
  const Automaton whole = minimise(*tabulate(*three_states, Sense::any_own_moves), Sense::any_own_moves);
  for (const char* criterion : {"finite:2", "finite:100", "discounted:0.5", "mean"}) {
    PreparedMachine asked_first(three_states, {{}, Criterion::parse(criterion)});
    EXPECT_EQ(*asked_first.whole(), whole) << criterion;
    PreparedMachine asked_last(three_states, {{}, Criterion::parse(criterion)});
    asked_last.minimal();
    EXPECT_EQ(*asked_last.whole(), whole) << criterion;
  }
  PreparedMachine gradual(registry.make("gradual").machine, {{}, Criterion::finite(5)});
  EXPECT_EQ(gradual.whole(), nullptr);
}

TEST(PreparedMachine, PlaysAsTheMachineDoes) {
  const Registry registry = Registry::standard();
  const auto played = [&](const char* name, const char* criterion) {
    const auto machine = registry.make(name).machine;
    return std::pair{machine, PreparedMachine(machine, {{}, Criterion::parse(criterion)}).player()};
  };
  const auto [pavlov, small] = played("pavlov", "finite:100");
  EXPECT_EQ(*std::dynamic_pointer_cast<const Automaton>(small),
            minimise(*tabulate(*pavlov, Sense::own_moves_its_own), Sense::own_moves_its_own));
  const auto [periodic, uncut] = played("per_ccd", "finite:2");  // its table ends too soon
  EXPECT_EQ(periodic, uncut);
  const auto [gradual, endless] = played("gradual", "discounted:0.9");
  EXPECT_EQ(gradual, endless);
}

TEST(PreparedMachine, RefusesAgainWithoutTryingAgain) {
  /// Every history is a state of its own.
  class Tree final : public Machine {
  public:
    State start() const override {
      ++begun;
      return 1;
    }
    double cooperation(State) const override { return 1; }
    State next(State state, Move own, Move theirs) const override { return 4 * state + 2 * bit(own) + bit(theirs); }
    bool finite() const override { return false; }

    mutable int begun = 0;
  };
  const auto tree = std::make_shared<Tree>();
  PreparedMachine prepared(tree, {{}, Criterion::finite(25)});
  EXPECT_THROW(prepared.minimal(), UsageError);
  EXPECT_THROW(prepared.minimal(), UsageError);
  EXPECT_EQ(tree->begun, 1);
}

TEST(PreparedMachines, AreOneAnAddress) {
  const Registry registry = Registry::standard();
  const auto pavlov = registry.make("pavlov").machine;
  PreparedMachines machines({{}, Criterion::mean()});
  EXPECT_EQ(&machines.of(pavlov), &machines.of(pavlov));
  EXPECT_NE(&machines.of(pavlov), &machines.of(registry.make("pavlov").machine));
  EXPECT_EQ(&machines.of(pavlov).machine(), pavlov.get());
}

}  // namespace
}  // namespace folk
