#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/equilibria/prepared_pair.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

std::shared_ptr<const Machine> machine_named(const char* name) { return Registry::standard().make(name).machine; }

/// Goes along with a machine and counts who begins it.
class Counted final : public Machine {
public:
  explicit Counted(std::shared_ptr<const Machine> machine)
      : machine_(std::move(machine)) {}

  State start() const override {
    ++begun;
    return machine_->start();
  }
  double cooperation(State state) const override { return machine_->cooperation(state); }
  State next(State state, Move own, Move theirs) const override { return machine_->next(state, own, theirs); }
  bool deterministic() const override { return machine_->deterministic(); }

  mutable int begun = 0;

private:
  std::shared_ptr<const Machine> machine_;
};

TEST(PreparedPair, KeepsItsPathWhereNothingIsChance) {
  PreparedMachines machines({{}, Criterion::discounted(0.9)});
  const PreparedPair pure(machines.of(machine_named("tit_for_tat")), machines.of(machine_named("all_d")));
  ASSERT_TRUE(pure.path());
  EXPECT_EQ(pure.path()->rounds, (std::vector<Outcome>{{Move::C, Move::D}, {Move::D, Move::D}}));
  EXPECT_FALSE(PreparedPair(machines.of(machine_named("random(0.5)")), machines.of(machine_named("all_d"))).path());
}

TEST(PreparedPair, RefusesMachinesWithoutEndUnderCriteriaWithoutEnd) {
  PreparedMachines machines({{}, Criterion::discounted(0.9)});
  PreparedMachine& gradual = machines.of(machine_named("gradual"));
  PreparedMachine& random = machines.of(machine_named("random(0.5)"));
  test::expect_error<UsageError>([&] { PreparedPair(gradual, gradual); }, "give a --horizon");
  EXPECT_EQ(PreparedPair(gradual, gradual, 40).horizon(), 40U);
  test::expect_error<UsageError>([&] { PreparedPair(gradual, random, 40); }, "no --horizon helps");
  test::expect_error<UsageError>([&] { PreparedPair(random, gradual, 40); }, "no --horizon helps");
  PreparedMachines finite({{}, Criterion::finite(5)});
  EXPECT_FALSE(PreparedPair(finite.of(machine_named("random(0.5)")), finite.of(machine_named("gradual"))).path());
}

/// A table of each sense and a path: whatever is asked, of however many pairs, and of its own best reply.
TEST(PreparedPair, GoesThroughEachMachineOnceAQuestion) {
  for (const char* name : {"pavlov", "random(0.5)"}) {
    const auto counted = std::make_shared<Counted>(machine_named(name));
    const EquilibriumQuestion question{{{}, Criterion::discounted(0.6)}, {{"itself", counted, {}}}};
    ClassReplies beliefs = class_replies(question);
    PreparedMachine& prepared = beliefs.machines().of(counted);
    const PreparedPair pair(prepared, prepared);
    const int paths = counted->begun;  // both seats of the path
    const PairGaps gaps = pair_gaps(pair, beliefs);
    EXPECT_TRUE(gaps.first.nash && gaps.first.subgame_perfect && gaps.first.self_confirming_class);
    pair_gaps(pair, beliefs);
    EXPECT_LE(counted->begun, paths + 2 + 4) << name;  // 4: does the member play along? for two sides, twice
  }
}

TEST(PreparedPair, HasTheGapsOfThePairAsItIs) {
  const auto classics = Registry::standard().roster("classics,random(0.5)");
  for (const char* criterion : {"discounted:0.8", "finite:20", "mean"}) {
    EquilibriumQuestion question{{{}, Criterion::parse(criterion)}, {classics[3], classics[10], classics[0]}, 0};
    ClassReplies beliefs = class_replies(question);
    for (const auto& first : classics)
      for (const auto& second : {classics[2], classics[10], classics.back()}) {
        if (!question.criterion.is_finite() && !first.machine->finite()) continue;
        const PreparedPair pair(beliefs.machines().of(first.machine), beliefs.machines().of(second.machine));
        const PairGaps kept = pair_gaps(pair, beliefs);
        const PairGaps fresh = pair_gaps(*first.machine, *second.machine, question);
        for (const auto& [a, b] : {std::pair(kept.first, fresh.first), std::pair(kept.second, fresh.second)}) {
          ASSERT_EQ(a.nash->gain, b.nash->gain) << first.name << " " << second.name << " " << criterion;
          ASSERT_EQ(a.subgame_perfect.has_value(), b.subgame_perfect.has_value());
          if (a.subgame_perfect) {
            ASSERT_EQ(a.subgame_perfect->gain, b.subgame_perfect->gain);
          }
          ASSERT_EQ(a.self_confirming_unrestricted->gain, b.self_confirming_unrestricted->gain);
          ASSERT_EQ(a.self_confirming_class.has_value(), b.self_confirming_class.has_value());
          if (a.self_confirming_class) {
            ASSERT_EQ(a.self_confirming_class->gain, b.self_confirming_class->gain);
          }
        }
      }
  }
}

}  // namespace
}  // namespace folk
