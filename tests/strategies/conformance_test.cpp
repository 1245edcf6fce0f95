// What every strategy must keep to, whatever it plays.

#include "strategies/named.h"

#include <folk/games/random.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <map>
#include <string>
#include <vector>

namespace folk {
namespace {

/// Every named strategy, and one of each family and form. Made once: whenever this program starts, each test is named
/// after one.
const std::vector<Strategy>& specimens() {
  static const auto all = [] {
    auto strategies = test::every_named();
    for (const auto& strategy : test::roster(
             "random(0.3),mem1(c;0.9,0.1,0.8,0.3),mem1(0.5;1,0,0.25,0),gtft(0.3),joss(0.9),zd_extort(3),zd_extort(2;0."
             "1),"
             "zd_generous(2),equalizer(2),per_ccdcd,mem12_ccCDCDDCDC,mem21_dcCDCDCDDC,mem22_cdCCDDCDCDDDCCCDDD"))
      strategies.push_back(strategy);
    return strategies;
  }();
  return all;
}

/// The places of those that are machines.
std::vector<std::size_t> machines() {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < specimens().size(); ++i)
    if (specimens()[i].machine) places.push_back(i);
  return places;
}

class Conformance : public ::testing::TestWithParam<std::size_t> {
protected:
  Strategy strategy = specimens()[GetParam()];
};

/// What machines must keep to besides.
class MachineConformance : public Conformance {};

TEST_P(Conformance, ItsNameMakesItAgain) {
  const Strategy again = Registry::standard().make(strategy.name);
  EXPECT_EQ(again.name, strategy.name);
}

TEST_P(Conformance, ItsNameIsMatchedWithoutCaseAndUnderscores) {
  std::string shouted;
  for (const char c : strategy.name)
    if (c != '_') shouted += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_EQ(Registry::standard().make(shouted).name, strategy.name);
}

TEST_P(Conformance, ItIsDescribed) {
  const auto registry = Registry::standard();
  const auto& description = registry.describe(strategy.name);
  EXPECT_FALSE(description.behaviour.empty());
  EXPECT_FALSE(description.reference.empty());
  for (const auto& alias : description.aliases) EXPECT_EQ(registry.make(alias).name, strategy.name);
}

TEST_P(MachineConformance, ItsStatesHoldProbabilitiesAndItSaysTruthfullyWhetherItMixes) {
  const Automaton table = unroll(*strategy.machine, Sense::any_own_moves, 12);
  bool mixes = false;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.beyond() == i) continue;
    EXPECT_GE(table.cooperation(i), 0);
    EXPECT_LE(table.cooperation(i), 1);
    mixes = mixes || (table.cooperation(i) > 0 && table.cooperation(i) < 1);
  }
  EXPECT_EQ(strategy.machine->deterministic(), !mixes);
}

TEST_P(MachineConformance, ItIsFiniteIffItSaysSo) {
  if (strategy.name == "mathieu_badbet") GTEST_SKIP() << "badbet but for a flag, and twice as many states";
  if (strategy.name.ends_with("majority_40")) GTEST_SKIP() << "2^40 states";
  // badbet alone needs millions.
  const std::size_t most = strategy.machine->finite() ? 5'000'000 : 100'000;
  const auto table = tabulate(*strategy.machine, Sense::any_own_moves, most);
  EXPECT_EQ(table.has_value(), strategy.machine->finite());
}

TEST_P(MachineConformance, PlayerAndMachineAndMinimalTableAgreeUnderAnyPlay) {
  const Machine& machine = *strategy.machine;
  const Automaton minimal = minimise(unroll(machine, Sense::any_own_moves, 12), Sense::any_own_moves);
  RandomStream random({7, GetParam(), 0, 0});
  for (std::uint64_t match = 0; match < 50; ++match) {
    const auto player = strategy.new_player();
    player->start({{}, Criterion::finite(12), {1, match, 0, 0}});
    State state = machine.start();
    State same = minimal.start();
    for (int t = 0; t < 12; ++t) {
      EXPECT_EQ(machine.cooperation(state), minimal.cooperation(same));
      const Move intended = player->move();
      if (machine.cooperation(state) == 1) {
        EXPECT_EQ(intended, Move::C);
      } else if (machine.cooperation(state) == 0) {
        EXPECT_EQ(intended, Move::D);
      }
      const Move own = random.chance(0.1) ? other(intended) : intended;
      const Move theirs = random.chance(0.5) ? Move::C : Move::D;
      player->observe(own, theirs);
      state = machine.next(state, own, theirs);
      same = minimal.next(same, own, theirs);
    }
  }
}

TEST_P(Conformance, ItPlaysTheSameAgainIfItIsDeterministicAndBelievesInProbabilities) {
  const bool deterministic = strategy.machine ? strategy.machine->deterministic() : strategy.deterministic;
  const auto first = strategy.new_player();
  const auto second = strategy.new_player();
  RandomStream random({10, GetParam(), 0, 0});
  for (std::uint64_t match = 0; match < 5; ++match) {
    first->start({{}, Criterion::finite(60), {1, match, 0, 0}});
    second->start({{}, Criterion::finite(60), {2, match, 0, 1}});
    std::array<Player*, 1> peers{first.get()};
    for (int t = 0; t < 60; ++t) {
      first->think_together(peers, 2);
      const Move own = first->move();
      const Move same = second->move();
      if (deterministic) {
        EXPECT_EQ(own, same);
        EXPECT_EQ(first->belief(), second->belief());
      }
      if (const auto belief = first->belief()) {
        EXPECT_TRUE(*belief >= 0 && *belief <= 1) << *belief;
      }
      const Move theirs = random.chance(0.6) ? Move::C : Move::D;
      first->observe(own, theirs);
      second->observe(own, theirs);
    }
  }
}

TEST_P(MachineConformance, ItsViewAsControlAndCountersKeepsTheState) {
  const Machine& machine = *strategy.machine;
  RandomStream random({8, GetParam(), 0, 0});
  State state = machine.start();
  for (int t = 0; t < 2000; ++t) {
    const CounterView view = machine.view(state);
    EXPECT_EQ(machine.state_of(view), state);
    for (std::size_t c = 0; c < view.size; ++c) {
      EXPECT_LE(view.counters[c].low, view.counters[c].value);
      EXPECT_LE(view.counters[c].value, view.counters[c].high);
    }
    EXPECT_TRUE(!machine.finite() || view.size == 0);
    state = machine.next(state, random.chance(machine.cooperation(state)) ? Move::C : Move::D,
                         random.chance(0.7) ? Move::C : Move::D);
  }
}

/// The contract of Machine: with control and number of counters kept, the next control and what is added to each
/// counter depend on (control, own, theirs) alone, as long as counters stay in the range of their control.
TEST_P(MachineConformance, ItsCountersDriftByControlAlone) {
  const Machine& machine = *strategy.machine;
  RandomStream random({9, GetParam(), 0, 0});
  std::map<std::pair<State, std::size_t>, std::array<std::int64_t, 2>> drifts;
  State state = machine.start();
  for (int t = 0; t < 5000; ++t) {
    const Move own = random.chance(machine.cooperation(state)) ? Move::C : Move::D;
    const Move theirs = random.chance(0.6) ? Move::C : Move::D;
    const State after = machine.next(state, own, theirs);
    const CounterView before = machine.view(state);
    const CounterView then = machine.view(after);
    state = after;
    if (before.size != then.size) continue;
    std::array<std::int64_t, 2> drift{};
    for (std::size_t c = 0; c < before.size; ++c) drift[c] = then.counters[c].value - before.counters[c].value;
    const auto [known, fresh] = drifts.try_emplace({before.control, Outcome{own, theirs}.index()}, drift);
    EXPECT_TRUE(fresh || known->second == drift) << strategy.name;
  }
}

std::string test_name(const ::testing::TestParamInfo<std::size_t>& tested) {
  std::string name = specimens()[tested.param].name;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name + "_" + std::to_string(tested.param);
}

INSTANTIATE_TEST_SUITE_P(All, Conformance, ::testing::Range<std::size_t>(0, specimens().size()), test_name);
INSTANTIATE_TEST_SUITE_P(All, MachineConformance, ::testing::ValuesIn(machines()), test_name);

TEST(Grudger, IsBlindToItsOwnDefection) {
  const Strategy grudger = Registry::standard().make("grudger");
  const Strategy spiteful = Registry::standard().make("spiteful");
  const auto after_slip = [](const Strategy& s) {
    return s.machine->cooperation(s.machine->next(s.machine->start(), Move::D, Move::C));
  };
  EXPECT_EQ(after_slip(grudger), 1);
  EXPECT_EQ(after_slip(spiteful), 0);
}

TEST(Lunatic, TossesAFairCoin) {
  const Strategy lunatic = Registry::standard().make("lunatic");
  EXPECT_EQ(lunatic.machine->cooperation(lunatic.machine->start()), 0.5);
}

}  // namespace
}  // namespace folk
