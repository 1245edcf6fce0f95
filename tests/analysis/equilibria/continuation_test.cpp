#include "analysis/beliefs/believing_player.h"
#include "analysis/play/naive.h"
#include "strategies/named.h"

#include <folk/analysis/equilibria/continuation.h>
#include <folk/analysis/equilibria/examination.h>
#include <folk/games/error.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace folk {
namespace {

using test::named;
using test::roster;

Strategy from_automaton(const std::string& name, const Automaton& automaton) {
  return {name, std::make_shared<Automaton>(automaton), nullptr};
}

/// The automaton after this play, as another automaton: its table with another start.
Automaton begun_after(const Automaton& automaton, const std::vector<Outcome>& history) {
  State state = automaton.start();
  for (const Outcome& round : history) state = automaton.next(state, round.own, round.theirs);
  return {automaton.nodes(), static_cast<std::uint32_t>(state)};
}

std::vector<Outcome> seen_by_them(std::vector<Outcome> history) {
  for (Outcome& round : history) round = round.exchanged();
  return history;
}

struct RandomQuestion {
  Automaton policy;
  Automaton opponent;
  std::vector<Automaton> members;
  ExaminationQuestion asked;
};

RandomQuestion random_question(RandomStream& random, const Criterion& criterion) {
  const Automaton policy = test::random_automaton(random, 4, true);
  const Automaton opponent = test::random_automaton(random, 4, true);
  std::vector<Automaton> members;
  for (int i = 0; i < 5; ++i) members.push_back(test::random_automaton(random, 2, true));
  RandomQuestion question{policy, opponent, members, {}};
  question.asked.criterion = criterion;
  question.asked.policy = from_automaton("policy", policy);
  question.asked.opponents = {from_automaton("opponent", opponent)};
  for (std::size_t i = 0; i < members.size(); ++i)
    question.asked.beliefs.push_back(from_automaton(std::string(1, static_cast<char>('a' + i)), members[i]));
  return question;
}

/// What the plain examination says of the pair when its automata, and those of the class, begin where the play before
/// has led them. The two sides are asked for one by one, each with its own class.
PairGaps plainly(const RandomQuestion& question, const std::vector<Outcome>& before, const Criterion& criterion) {
  const auto theirs = seen_by_them(before);
  EquilibriumQuestion asked;
  asked.criterion = criterion;
  const auto gaps_with = [&](const std::vector<Outcome>& told) {
    asked.beliefs.clear();
    for (std::size_t i = 0; i < question.members.size(); ++i)
      asked.beliefs.push_back(
          from_automaton(std::string(1, static_cast<char>('a' + i)), begun_after(question.members[i], told)));
    return pair_gaps(begun_after(question.policy, before), begun_after(question.opponent, theirs), asked);
  };
  return {gaps_with(theirs).first, gaps_with(before).second};
}

bool equal_gaps(const SideGaps& a, const SideGaps& b) {
  const auto equal = [](const std::optional<Gap>& one, const std::optional<Gap>& other) {
    return one.has_value() == other.has_value() && (!one || one->exact == other->exact);
  };
  return equal(a.nash, b.nash) && equal(a.subgame_perfect, b.subgame_perfect) &&
         equal(a.self_confirming_unrestricted, b.self_confirming_unrestricted) &&
         equal(a.self_confirming_class, b.self_confirming_class);
}

bool begins_with(const std::vector<Outcome>& history, const std::vector<Outcome>& before) {
  return history.size() >= before.size() && std::equal(before.begin(), before.end(), history.begin());
}

TEST(Continuation, IsThePlainExaminationOfThePairThatBeginsThere) {
  RandomStream random({20});
  std::size_t with_a_belief = 0;
  for (const char* criterion : {"finite:7", "discounted:0.7", "mean"})
    for (int pair = 0; pair < 40; ++pair) {
      RandomQuestion question = random_question(random, Criterion::parse(criterion));
      for (std::uint64_t from = 1; from <= 7; ++from) {
        question.asked.from = from;
        const auto found = examine(question.asked).pairs.front();
        const auto before = first_rounds_of(question.policy, question.opponent, from - 1);
        EXPECT_EQ(found.before, before);
        const bool ends = question.asked.criterion.is_finite();
        const auto expected = plainly(question, before, ends ? Criterion::finite(8 - from) : question.asked.criterion);
        ASSERT_TRUE(equal_gaps(found.gaps.first, expected.first)) << criterion << " pair " << pair << " from " << from;
        ASSERT_TRUE(equal_gaps(found.gaps.second, expected.second)) << criterion << " pair " << pair;
        with_a_belief += found.gaps.first.self_confirming_class ? 1U : 0U;
        const Witness& own = found.gaps.first.nash->witness;
        EXPECT_TRUE(!own.deviation || begins_with(own.history, before));
        const Witness& theirs = found.gaps.second.self_confirming_unrestricted->witness;
        EXPECT_TRUE(!theirs.deviation || begins_with(theirs.history, seen_by_them(before)));
        EXPECT_EQ(ends ? found.path->rounds.size() : 0U, ends ? 8 - from : 0U);
      }
    }
  EXPECT_GT(with_a_belief, 100U);
}

// spiteful is exploited once; from round 2 on both play D, which is an equilibrium for every d.
TEST(Continuation, OfSpitefulAgainstAllDByHand) {
  ExaminationQuestion question;
  question.criterion = Criterion::parse("discounted:0.9");
  question.policy = named("spiteful");
  question.opponents = roster("all_d");
  question.beliefs = roster("tit_for_tat,spiteful");
  const auto whole = examine(question);
  EXPECT_EQ(whole.verdict(Notion::nash)->verdict, Verdict::refuted);
  question.from = 2;
  const auto later = examine(question).pairs.front();
  EXPECT_EQ(later.own_score, 1);
  EXPECT_EQ(later.gaps.first.nash->exact, Rational(0));
  EXPECT_EQ(to_text(later.thresholds->nash->set), "(0, 1)");
  EXPECT_EQ(later.gaps.first.self_confirming_class->witness.belief, "spiteful");
  EXPECT_EQ(later.gaps.second.self_confirming_class->witness.belief, "spiteful");
  // In the place of all_d, tit_for_tat has seen a C and would play C in round 2; in that of spiteful it has seen a D.
  question.beliefs = roster("tit_for_tat");
  const auto copied = examine(question).pairs.front();
  EXPECT_FALSE(copied.gaps.first.self_confirming_class);
  EXPECT_EQ(copied.gaps.second.self_confirming_class->witness.belief, "tit_for_tat");
}

Strategy looked_at_only_by_play(const std::string& name) {
  Strategy strategy;
  strategy.name = "played " + name;
  strategy.make_player = [machine = named(name).machine] { return play(machine); };
  strategy.deterministic = true;
  return strategy;
}

// What is only played has the gaps of the machine that it is, as far as they can be known.
TEST(Continuation, OfAPlayedPolicyIsThatOfTheMachineThatItIs) {
  ExaminationQuestion question;
  question.criterion = Criterion::parse("finite:12");
  question.opponents = roster("per_ccd,gradual,prober");
  question.beliefs = roster("classics");
  for (const std::uint64_t from : {2U, 5U, 12U}) {
    question.from = from;
    question.policy = named("tf2t");
    const auto machine = examine(question);
    question.policy = looked_at_only_by_play("tf2t");
    const auto played = examine(question);
    for (std::size_t i = 0; i < question.opponents.size(); ++i) {
      const auto& one = machine.pairs[i];
      const auto& other = played.pairs[i];
      EXPECT_EQ(one.own_score, other.own_score) << from;
      EXPECT_EQ(one.before, other.before);
      EXPECT_EQ(one.gaps.first.nash->exact, other.gaps.first.nash->exact) << one.opponent << from;
      EXPECT_EQ(one.gaps.second.self_confirming_unrestricted->exact,
                other.gaps.second.self_confirming_unrestricted->exact);
      EXPECT_EQ(one.gaps.second.self_confirming_class->exact, other.gaps.second.self_confirming_class->exact);
      EXPECT_EQ(witness_text(*one.gaps.first.nash), witness_text(*other.gaps.first.nash));
    }
  }
}

// After CC CC, all_c earns 3 a round of tit_for_tat and the word ccd 5 in the third: a reply that all_c could copy.
// That of all_d cannot be copied any more.
TEST(Continuation, OnlyRepliesWithTheSameBeginningCanBeCopied) {
  ExaminationQuestion question;
  question.criterion = Criterion::parse("finite:3");
  question.policy = looked_at_only_by_play("tit_for_tat");
  question.opponents = roster("all_c,per_ccd,all_d");
  question.beliefs = roster("tit_for_tat");
  question.from = 3;
  const auto found = examine(question);
  EXPECT_EQ(found.pairs[0].gaps.second.nash->gain, 2);
  EXPECT_EQ(found.pairs[0].gaps.second.nash->tried, "the replies of 2 strategies");
  EXPECT_EQ(found.pairs[2].gaps.second.nash->gain, 0);
  EXPECT_EQ(found.pairs[2].gaps.second.nash->tried, "the replies of 1 strategies");
}

// It expects all_d and plays C against all_c: each D of the rounds that are left, up to 6, gains a point, and beliefs
// of earlier rounds do not count.
TEST(Continuation, JudgesTheBeliefsOfTheRoundsThatAreLeft) {
  ExaminationQuestion question;
  question.criterion = Criterion::parse("finite:8");
  question.policy = test::believer("all_c", "all_d");
  question.opponents = roster("all_c");
  question.beliefs = roster("all_c");
  question.from = 6;
  const auto pair = examine(question).pairs.front();
  EXPECT_EQ(pair.gaps.first.self_confirming_own->gain, 3);
  EXPECT_EQ(pair.own_search->round, 6U);
  EXPECT_EQ(pair.gaps.first.self_confirming_own->witness.history.size(), 5U);
  EXPECT_EQ(pair.belief->rounds, 3U);
  EXPECT_EQ(pair.belief->wrong_rounds, (std::vector<std::uint64_t>{6, 7, 8}));
}

TEST(CheckFrom, RefusesWhatIsNotOnePath) {
  ExaminationQuestion question;
  question.criterion = Criterion::parse("finite:10");
  question.policy = named("pavlov");
  question.opponents = roster("all_d,random(0.5)");
  question.beliefs = roster("all_d");
  question.from = 2;
  test::expect_error<UsageError>([&] { examine(question); }, "random(0.5) may draw its moves");
  question.opponents = roster("all_d");
  EXPECT_NO_THROW(examine(question));
  question.from = 11;
  test::expect_error<UsageError>([&] { examine(question); }, "expected round 1 to 10");
  question.from = 0;
  EXPECT_THROW(examine(question), UsageError);
  question.from = 2;
  question.noise = 0.1;
  test::expect_error<UsageError>([&] { examine(question); }, "random under noise");
  question.noise = 0;
  question.criterion = Criterion::parse("mean");
  question.from = most_path_rounds + 1;
  EXPECT_THROW(examine(question), UsageError);
}

}  // namespace
}  // namespace folk
