#include "analysis/play/naive.h"

#include "csv.h"

#include <folk/analysis/play/deterministic_play.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

namespace folk {
namespace {

const std::vector<Strategy>& everyone() {
  static const auto roster = Registry::standard().roster(
      "classics,gradual_sct,gradual_soft,mem2_sct,badbet,winner12,winner21,tft_spiteful,grudger,per_ccdcd,"
      "mem11_dDCDC,mem12_dcDDCDCDDC");
  return roster;
}

RC_GTEST_PROP(DeterministicPlay, AgreesWithNaivePlayForAnyPairAndLength, ()) {
  const auto& a = *rc::gen::elementOf(everyone());
  const auto& b = *rc::gen::elementOf(everyone());
  if (!a.machine->deterministic() || !b.machine->deterministic()) return;
  const auto rounds = *rc::gen::inRange<std::uint64_t>(1, 5000);
  const auto exact = play_deterministic(*a.machine, *b.machine, Criterion::finite(rounds));
  RC_ASSERT(exact.weights == test::play_naively(*a.machine, *b.machine, rounds));
}

TEST(DeterministicPlay, AgreesWithNaiveDiscounting) {
  for (const auto& a : everyone())
    for (const auto& b : everyone()) {
      const auto exact = play_deterministic(*a.machine, *b.machine, Criterion::discounted(0.97));
      const auto ending = play_deterministic(*a.machine, *b.machine, Criterion::ending(0.03));
      const auto naive = test::play_naively(*a.machine, *b.machine, 2000, 0.97);
      for (std::size_t o = 0; o < 4; ++o) {
        EXPECT_NEAR(exact.weights[o], 0.03 * naive[o], 1e-12) << a.name << " v " << b.name;
        EXPECT_NEAR(ending.weights[o], naive[o], 1e-10) << a.name << " v " << b.name;
      }
    }
}

TEST(DeterministicPlay, PlaysATrillionRoundsOfEveryClosedPairAndKeepsTheTotal) {
  for (const auto& a : everyone())
    for (const auto& b : everyone()) {
      if (a.name.starts_with("gradual") || b.name.starts_with("gradual")) continue;
      const auto exact = play_deterministic(*a.machine, *b.machine, Criterion::finite(1'000'000'000'000), 100'000);
      EXPECT_EQ(exact.weights[0] + exact.weights[1] + exact.weights[2] + exact.weights[3], 1e12)
          << a.name << " v " << b.name;
      const auto mean = play_deterministic(*a.machine, *b.machine, Criterion::mean(), 100'000);
      for (std::size_t o = 0; o < 4; ++o)
        EXPECT_NEAR(mean.weights[o], exact.weights[o] / 1e12, 1e-6) << a.name << " v " << b.name;
      EXPECT_EQ(mean.method, Method::cycle) << a.name << " v " << b.name;
    }
}

TEST(DeterministicPlay, SkipsThePunishmentsOfGradual) {
  const auto registry = Registry::standard();
  const auto gradual = registry.make("gradual");
  for (const char* name : {"all_d", "per_ddc", "per_ccd", "per_cd"}) {
    const auto opponent = registry.make(name);
    const auto exact = play_deterministic(*gradual.machine, *opponent.machine, Criterion::finite(3'000'000), 5000);
    EXPECT_EQ(exact.weights, test::play_naively(*gradual.machine, *opponent.machine, 3'000'000)) << name;
  }
}

TEST(DeterministicPlay, FindsLongCyclesInNoMemory) {
  std::string long_word(1999, 'c');
  long_word += 'd';
  const auto registry = Registry::standard();
  const auto a = registry.make("per_" + long_word);
  const auto b = registry.make("per_" + long_word.substr(1));
  const auto sum = play_deterministic(*a.machine, *b.machine, Criterion::finite(2000 * 1999 * 1000ULL));
  EXPECT_EQ(sum.weights[3], 1000);  // both defect once in 2000 x 1999 rounds
  EXPECT_EQ(play_deterministic(*a.machine, *b.machine, Criterion::mean()).method, Method::cycle);
}

TEST(DeterministicPlay, RefusesWhatNeitherClosesNorEnds) {
  const auto registry = Registry::standard();
  const auto gradual = registry.make("gradual");
  const auto all_d = registry.make("all_d");
  EXPECT_THROW(play_deterministic(*gradual.machine, *all_d.machine, Criterion::finite(1'000'000'000'000)), UsageError);
  EXPECT_THROW(play_deterministic(*gradual.machine, *all_d.machine, Criterion::finite(100'000), 10), UsageError);
  EXPECT_EQ(play_deterministic(*gradual.machine, *all_d.machine, Criterion::mean()).method, Method::bounded);
}

TEST(DeterministicPlay, HasThePublishedVariantsOfGradualAndMem2) {
  const auto registry = Registry::standard();
  const std::map<std::size_t, std::string> columns{
      {2, "gradual"}, {3, "gradual_soft"}, {4, "gradual_sct"}, {6, "mem2"}, {8, "mem2_sct"}};
  const auto rows = test::read_csv("gradual_mem2_variants.csv");
  for (std::size_t i = 1; i < rows.size(); ++i)
    for (const auto& [column, name] : columns) {
      const auto opponent = registry.make(rows[i][1]);
      const auto w = play_deterministic(*registry.make(name).machine, *opponent.machine,
                                        Criterion::finite(std::stoull(rows[i][0])))
                         .weights;
      EXPECT_EQ(3 * w[0] + 5 * w[2] + w[3], std::stod(rows[i][column])) << name << " v " << rows[i][1];
    }
}

}  // namespace
}  // namespace folk
