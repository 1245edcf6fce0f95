#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/play/criterion_table.h>
#include <folk/analysis/replies/class_replies.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(ClassReplies, AreTheBestReplies) {
  const auto classics = Registry::standard().roster("classics");
  for (const auto& criterion : {Criterion::discounted(0.9), Criterion::finite(10)}) {
    ClassReplies replies(classics, {{}, criterion}, 20);
    for (std::size_t i = 0; i < classics.size(); ++i) {
      const BestReply fresh = best_reply(*classics[i].machine, {{}, criterion}, 20);
      EXPECT_EQ(replies.reply(i).exact, fresh.exact);
      EXPECT_EQ(replies.reply(i).payoff, fresh.payoff);
      EXPECT_EQ(replies.reply(i).machine, fresh.machine);
      EXPECT_EQ(&replies.reply(i), &replies.reply(i));
      EXPECT_EQ(replies.table(i), table_for(*classics[i].machine, criterion, Sense::own_moves_its_own, 20));
      EXPECT_EQ(replies.endless(i), !criterion.is_finite() && !classics[i].machine->finite());
    }
  }
}

TEST(ClassReplies, RefuseWhatHasNoExactReply) {
  ClassReplies replies(Registry::standard().roster("gradual"), {{}, Criterion::mean()});
  EXPECT_EQ(replies.horizon(), 100U);
  EXPECT_THROW(replies.reply(0), UsageError);
  EXPECT_THROW(replies.table(0), UsageError);
}

/// Replies that are kept from pair to pair change no figure.
TEST(ClassReplies, AreTheSameForAllPairsOfAQuestion) {
  const auto classics = Registry::standard().roster("classics");
  const EquilibriumQuestion question{{{}, Criterion::discounted(0.9)}, classics, 30};
  ClassReplies kept = class_replies(question);
  for (const char* name : {"pavlov", "tit_for_tat", "gradual"}) {
    const auto machine = Registry::standard().make(name).machine;
    const auto with = pair_gaps(*machine, *machine, question, kept).first.self_confirming_class;
    const auto without = pair_gaps(*machine, *machine, question).first.self_confirming_class;
    EXPECT_EQ(with->exact, without->exact) << name;
    EXPECT_EQ(with->witness.belief, without->witness.belief) << name;
  }
}

}  // namespace
}  // namespace folk
