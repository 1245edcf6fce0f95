#include <folk/strategies/automaton.h>

#include <folk/strategies/machine_text.h>
#include <gtest/gtest.h>

#include "games/expect_error.h"

namespace folk {
namespace {

using NamesByState = std::vector<std::vector<std::string>>;

Automaton machine_of(const std::string& lines) { return read_machines("machine m\n" + lines, "test").front().machine; }

TEST(StateNames, AFileSaysThemAndTheyDoNotCountAsPlay) {
  const Automaton named = machine_of("calm C calm angry\nangry D calm angry\n");
  EXPECT_EQ(named.state_names(), (std::vector<std::string>{"calm", "angry"}));
  EXPECT_TRUE(named == read_machine_line("c C c d; d D c d"));
  EXPECT_TRUE(read_machine_line("c C c d; d D c d").state_names().empty());
}

TEST(StateNames, ThereIsOneAState) {
  test::expect_error<UsageError>([] { Automaton({{1, {0, 0, 0, 0}}}, 0, std::nullopt, {"a", "b"}); }, "2 names");
}

TEST(NamesBehind, EachStateHasThoseThatItStandsFor) {
  // b and c play alike, and d cannot be reached.
  const Automaton machine = machine_of("a C b c\nb D a b\nc D a c\nd D d d\n");
  const Automaton smallest = minimise(*tabulate(machine, Sense::own_moves_its_own), Sense::own_moves_its_own);
  EXPECT_EQ(names_behind(smallest, machine, Sense::own_moves_its_own), (NamesByState{{"a"}, {"b", "c"}}));
}

TEST(NamesBehind, TheSenseSaysWhatCanBeReached) {
  // Only a slip leads to hurt.
  const Automaton machine = machine_of("ok C ok ok hurt hurt\nhurt D hurt hurt hurt hurt\n");
  const auto names = [&](Sense sense) {
    return names_behind(minimise(*tabulate(machine, sense), sense), machine, sense);
  };
  EXPECT_EQ(names(Sense::own_moves_its_own), (NamesByState{{"ok"}}));
  EXPECT_EQ(names(Sense::any_own_moves), (NamesByState{{"ok"}, {"hurt"}}));
}

TEST(NamesBehind, AHorizonHasNoName) {
  const Automaton machine = machine_of("one C two two\ntwo C three three\nthree D three three\n");
  const Automaton cut = unroll(machine, Sense::own_moves_its_own, 2);
  ASSERT_TRUE(cut.beyond());
  const auto names = names_behind(cut, machine, Sense::own_moves_its_own);
  EXPECT_EQ(names[0], std::vector<std::string>{"one"});
  EXPECT_TRUE(names[*cut.beyond()].empty());
}

TEST(NamesBehind, NobodyNamedThem) {
  const Automaton machine = read_machine_line("c C c d; d D c d");
  EXPECT_EQ(names_behind(machine, machine, Sense::own_moves_its_own), NamesByState(2));
}

}  // namespace
}  // namespace folk
