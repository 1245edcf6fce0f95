#include <folk/analysis/equilibria/extracted_machine.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <map>

namespace folk {
namespace {

/// A machine that nobody can look into.
Strategy opaque(const char* name) {
  Strategy strategy;
  strategy.name = name;
  strategy.make_player = [machine = Registry::standard().make(name).machine] { return play(machine); };
  strategy.deterministic = true;
  return strategy;
}

ExaminationQuestion question_of(const char* policy, std::uint64_t rounds) {
  ExaminationQuestion question;
  question.criterion = Criterion::finite(rounds);
  question.policy = opaque(policy);
  question.opponents = Registry::standard().roster("all_c,all_d,per_ccd,random(0.5)");
  question.repetitions = 3;
  return question;
}

TEST(ExtractedMachine, IsTheMachineThatPlayed) {
  const auto question = question_of("tf2t", 20);
  const auto unseen = Registry::standard().roster("pavlov,prober");
  std::map<std::string, double> told;
  const Stages stages = [&](const std::string& stage) { return [&told, stage](double share) { told[stage] = share; }; };
  const auto extracted = extract_machine(question, examine(question), unseen, "two others", stages);
  EXPECT_EQ(extracted.choice().machine,
            minimise(*tabulate(*Registry::standard().make("tf2t").machine, Sense::own_moves_its_own),
                     Sense::own_moves_its_own));
  EXPECT_EQ(extracted.choice().matches.told(), 1);
  EXPECT_EQ(extracted.unseen_name, "two others");
  ASSERT_EQ(extracted.unseen.matches.size(), 2U);
  EXPECT_EQ(extracted.unseen.matches[1].opponent, "prober");
  EXPECT_EQ(extracted.unseen.matches[1].moves, 20U);
  EXPECT_EQ(extracted.unseen.played(), 1);
  EXPECT_EQ(told,
            (std::map<std::string, double>{{"extracting an automaton", 1}, {"testing it on unseen opponents", 1}}));
}

/// The depth of what is laid out stays within short matches.
TEST(ExtractedMachine, ComesOutOfShortMatchesToo) {
  const auto question = question_of("tit_for_tat", 3);
  const auto extracted = extract_machine(question, examine(question), {}, "nobody");
  EXPECT_EQ(extracted.choice().machine.size(), 2U);
  EXPECT_TRUE(extracted.unseen.matches.empty());
}

}  // namespace
}  // namespace folk
