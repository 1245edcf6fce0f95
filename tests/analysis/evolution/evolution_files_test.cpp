// What is written down and read again: journals of evolutions, tables of scores.

#include "analysis/evolution/some_scores.h"
#include "games/expect_error.h"

#include <folk/analysis/evolution/evolution_journal.h>
#include <folk/analysis/evolution/finite_population.h>
#include <folk/analysis/evolution/integer_selection.h>
#include <folk/analysis/evolution/population_cooperation.h>
#include <folk/analysis/evolution/score_table.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

using test::scores_of;

TEST(EvolutionJournal, GoesOnAsIfNothingHadBeen) {
  const auto scores = scores_of("classics");
  const Population start(17, 10);
  const auto model = std::make_shared<FinitePopulation>(
      scores, start, SelectionRules{Process::birth_death, Fitness::linear, Rational(1, 10), false}, 0.01);
  Evolution whole(model, start, 4);
  whole.run(900);
  Evolution first(model, start, 4);
  first.run(333);
  Evolution second(model, start, 4);
  second.restore(read_evolution_journal(journal_text(first.state(), first.identity()), "j", second.identity(), 17));
  second.run(900);
  EXPECT_EQ(journal_text(whole.state(), 1), journal_text(second.state(), 1));
  EXPECT_NE(Evolution(model, start, 5).identity(), first.identity());
}

TEST(EvolutionJournal, RefusesWhatIsNotItsOwn) {
  const auto scores = scores_of("all_c,all_d");
  const Population start{5, 5};
  Evolution evolution(std::make_shared<IntegerSelection>(scores, start), start);
  evolution.run(3);
  const auto text = journal_text(evolution.state(), 7);
  test::expect_error<InputFileError>([&] { read_evolution_journal(text, "j", 8, 2); }, "another run");
  test::expect_error<InputFileError>([&] { read_evolution_journal(text.substr(0, text.size() / 2), "j", 7, 2); },
                                     "damaged");
  test::expect_error<InputFileError>([&] { read_evolution_journal("", "j", 7, 2); }, "not a journal");
  test::expect_error<InputFileError>([&] { read_fixation_journal(text, "j", 7, 2); }, "not a journal");
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto bad = text;
    bad[i] = bad[i] == '1' ? '2' : '1';
    if (bad == text) continue;
    EXPECT_THROW(read_evolution_journal(bad, "j", 7, 2), InputFileError) << i;
  }
  EXPECT_THROW(read_evolution_journal(text, "j", 7, 3), InputFileError);
}

TEST(EvolutionJournal, KeepsCountsOfRuns) {
  const FixationCounts counts{10, {3, 5}, 2};
  const auto text = journal_text(counts, 3);
  const auto read = read_fixation_journal(text, "j", 3, 2);
  EXPECT_EQ(read.runs, 10U);
  EXPECT_EQ(read.taken_over, counts.taken_over);
  EXPECT_EQ(read.unsettled, 2U);
  EXPECT_THROW(read_fixation_journal(journal_text({10, {3, 5}, 1}, 3), "j", 3, 2), InputFileError);
}

TEST(PopulationHistory, IsThinnedWhereItIsLong) {
  PopulationHistory history;
  const Population population(1024, 1);
  for (std::uint64_t generation = 0; generation <= 5000; ++generation) history.add(generation, population);
  EXPECT_EQ(history.stride(), 4U);
  EXPECT_EQ(history.rows().back().generation, 5000U);
  EXPECT_EQ(history.rows()[255].generation, 255U);  // the first 256 are all there
  EXPECT_EQ(history.rows()[257].generation, 260U);
  EXPECT_LE(history.rows().size() * 1024, PopulationHistory::most_numbers);
}

TEST(PopulationHistory, OfVeryManyStrategiesEndsToo) {
  PopulationHistory history;
  const Population population(20000, 1);
  for (std::uint64_t generation = 0; generation <= 200; ++generation) history.add(generation, population);
  EXPECT_LE(history.rows().size() * 20000, PopulationHistory::most_numbers);
  EXPECT_EQ(history.mean_of_last_quarter().front(), 1);
}

TEST(ScoreTable, ReadsWhatTournamentsWrite) {
  const auto table =
      read_score_table("row\\col,a,\"b,\"\"c\"\"\",total\na,3,1/2,x\n\"b,\"\"c\"\"\",5,1.25,\r\n\n", "t");
  EXPECT_EQ(table.names, (std::vector<std::string>{"a", "b,\"c\""}));
  EXPECT_EQ(table.rows[0][1], Rational(1, 2));
  EXPECT_EQ(table.rows[1][1], Rational(5, 4));
  const ScoreMatrix scores(table.names, table.rows, 10);
  EXPECT_TRUE(scores.exact());
  EXPECT_EQ(scores.whole(0, 1), 2);
  EXPECT_EQ(scores.unit(), Rational(1, 4));
  EXPECT_EQ(scores.payoff(1, 0), 0.5);
}

TEST(ScoreTable, SaysWhatIsWrong) {
  const auto refused = [](const char* text, const char* says) {
    test::expect_error<InputFileError>([&] { read_score_table(text, "t"); }, says);
  };
  refused("", "no table of scores");
  refused("a\n", "t:1: expected a header");
  refused("x,a,b\na,1\n", "t:2: 2 fields: expected 3");
  refused("x,a,b\nb,1,2\n", "t:2: row 'b': expected 'a'");
  refused("x,a,b\na,1,z\n", "t:2: 'z' against 'b': expected a number");
  refused("x,a,b\na,1,\n", "self-play");
  refused("x,a,b\na,1,2\n", "1 rows for 2 columns");
  refused("x,a\na,1\nb,2\n", "t:3: more rows");
  refused("x,\"a\na,1\n", "t:1: a quote is not closed");
  test::expect_error<UsageError>([&] { ScoreMatrix({"a", "A"}, {{1, 1}, {1, 1}}, 1); }, "twice");
}

TEST(ScoreMatrix, KeepsFortyDigitsOfWhatWasRounded) {
  const auto scores = scores_of("all_c,tit_for_tat,all_d", Criterion::discounted(0.9));
  EXPECT_FALSE(scores->exact());
  EXPECT_NEAR(scores->score(0, 1), 3, 1e-11);
  EXPECT_EQ(scores->whole(scores->behaviour(0), scores->behaviour(1)),
            scores->whole(scores->behaviour(1), scores->behaviour(1)));
  test::expect_error<UsageError>([&] { scores_of("gradual,all_d", Criterion::mean()); }, "horizon");
}

TEST(PopulationCooperation, OfOneIsWhatItPlaysAgainstItself) {
  const auto scores = scores_of("all_c,all_d");
  EXPECT_EQ(population_cooperation(*scores, {1, 0}, false), 1.0);
  EXPECT_EQ(population_cooperation(*scores, {1, 1}, false), 0.5);
  EXPECT_EQ(population_cooperation(*scores, {0.25, 0.75}, true), 0.25);
}

}  // namespace
}  // namespace folk
