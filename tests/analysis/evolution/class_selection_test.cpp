#include <folk/analysis/evolution/class_selection.h>
#include <folk/analysis/evolution/evolution.h>
#include <folk/analysis/evolution/evolution_journal.h>
#include <folk/analysis/evolution/integer_selection.h>
#include <folk/analysis/evolution/population_cooperation.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <analysis/classes/naive_class.h>
#include <cases.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace folk {
namespace {

TEST(ClassSelection, IsTheEcologyOfAListedRoster) {
  for (const auto& [own, theirs] : {std::pair{1U, 1U}, {1U, 2U}, {2U, 1U}}) {
    const MemoryClass members(own, theirs);
    TournamentSettings settings;
    settings.criterion = Criterion::finite(1000);
    const auto scores =
        std::make_shared<ScoreMatrix>(play_tournament(Registry::standard().roster(members.name()), settings));
    const Population start(scores->size(), 100);
    Evolution listed(std::make_shared<IntegerSelection>(scores, start), start);
    const auto selection = std::make_shared<ClassSelection>(members, settings.payoffs, settings.criterion, start, 2);
    Evolution whole(selection, start);
    for (const std::uint64_t generations : {1U, 2U, 3U, 10U, 40U, 400U}) {
      listed.run(generations);
      whole.run(generations);
      ASSERT_EQ(whole.state().population, listed.state().population) << members.name() << ", " << generations;
      EXPECT_EQ(whole.state().extinct_at, listed.state().extinct_at);
      EXPECT_NEAR(selection->cooperation(whole.state().population),
                  *population_cooperation(*scores, listed.state().population, false), 1e-9);
    }
    EXPECT_EQ(whole.state().end, listed.state().end);
  }
}

// The first three generations of the largest class that is taken as a whole, some members pair by pair: a few here,
// FOLK_CLASS_MEMBERS=200 as many, a minute.
TEST(ClassSelection, AgreesWithPairsInTheLargestClass) {
  const MemoryClass members(2, 2);
  const auto tables = test::listed(members);
  const MatchRules rules{{}, Criterion::finite(1000)};
  const Population start(tables.size(), 100);
  const ClassSelection selection(members, rules.payoffs, rules.criterion, start, 2);
  const char* more = std::getenv("FOLK_CLASS_MEMBERS");
  const int count = more != nullptr ? std::atoi(more) : 4;
  std::mt19937 random(5);
  RandomStream unused;
  Population now = start;
  CycleFinder finder;
  for (int generation = 1; generation <= (more != nullptr ? 3 : 1); ++generation) {
    Population next = now;
    selection.advance(next, unused);
    // n' = floor(N n each / all) says between which two numbers the sum over all members lies: all say the same.
    double low = 0;
    double high = 1e300;
    for (int i = 0; i < count; ++i) {
      const std::size_t member = random() % tables.size();
      if (!(now[member] > 0)) continue;
      double each = -test::naive_match(finder, tables[member], tables[member], rules).own;
      for (std::size_t j = 0; j < tables.size(); ++j)
        if (now[j] > 0) each += now[j] * test::naive_match(finder, tables[member], tables[j], rules).own;
      const double grown = 26'214'400.0 * now[member] * each;
      low = std::max(low, grown / (next[member] + 1));
      if (next[member] > 0) high = std::min(high, grown / next[member]);
      EXPECT_LT(low, high) << generation << " " << member;
    }
    now = next;
  }
}

TEST(ClassSelection, RefusesWhatItCannotCount) {
  const Population start(32, 100);
  Payoffs negative;
  negative.sucker = -1;
  EXPECT_THROW(ClassSelection({1, 1}, negative, Criterion::finite(10), start, 1), UsageError);
  EXPECT_THROW(ClassSelection({1, 1}, {}, Criterion::finite(10), Population(32, 1e12), 1), UsageError);
}

TEST(Evolution, SummariesGoThroughTheJournal) {
  const MemoryClass members(1, 1);
  const Population start(32, 100);
  const auto selection = std::make_shared<ClassSelection>(members, Payoffs{}, Criterion::finite(1000), start, 1);
  Evolution whole(selection, start);
  whole.run(12);
  Evolution half(selection, start);
  half.run(5);
  Evolution rest(selection, start);
  rest.restore(read_evolution_journal(journal_text(half.state(), 7), "j", 7, 32));
  rest.run(12);
  EXPECT_EQ(rest.state().summaries, whole.state().summaries);
  ASSERT_EQ(whole.state().summaries.size(), 13U);
  EXPECT_EQ(whole.state().summaries[12].leader, 0b00111U);
  EXPECT_EQ(whole.state().summaries[12].number, 1785);
  EXPECT_EQ(whole.state().summaries[12].living, 18U);
}

}  // namespace
}  // namespace folk
