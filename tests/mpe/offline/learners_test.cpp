// The offline learners by name: what each budget gives them, and settings that are not theirs.

#include <folk/mpe/data/data_figures.h>
#include <folk/mpe/offline/learners.h>
#include <folk/mpe/offline/omar.h>
#include <folk/mpe/players/any_policy.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/data/small_data_set.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

/// Eight episodes that say of which level they are; nothing when it is empty.
class SmallData {
public:
  explicit SmallData(const std::string& level = {}, const char* scenario = "simple_tag")
      : files_(test::files_of(test::played_arrays(Layout(Scenario::named(scenario)), test::pursuit_cast(), 3, 0, 8))) {
    if (level.empty()) return;
    DataRecord record{test::description(Layout(Scenario::named(scenario)), test::pursuit_cast(), 8), {}};
    record.description.level = level;
    record.figures = data_figures(test::parse(files_));
    files_[metadata_name] = metadata_text(record);
  }

  DataSet data() const { return test::parse(files_); }

private:
  test::Files files_;
};

const DataSet& small_data() {
  static const SmallData small;
  static const DataSet data = small.data();
  return data;
}

LearnerChoice choice_of(LearnerKind kind, Budget budget = Budget::smoke) {
  LearnerChoice choice;
  choice.kind = kind;
  choice.budget = budget;
  choice.batch = 20;  // OMAR's is larger than the data
  choice.level = "expert";
  return choice;
}

/// The value of a key in a description.
std::string said(const OfflineLearner& learner, const std::string& key) {
  const std::string text = "\n" + learner.description();
  const auto begin = text.find("\n" + key + " = ");
  if (begin == std::string::npos) return "nothing";
  const auto from = begin + key.size() + 4;
  return text.substr(from, text.find('\n', from) - from);
}

// ---- names -------------------------------------------------------------------------------------------------------

TEST(Learners, HaveNames) {
  std::set<std::string> names;
  for (const auto kind : learner_kinds) {
    EXPECT_EQ(parse_learner(to_string(kind)), kind);
    names.insert(std::string(to_string(kind)));
  }
  EXPECT_EQ(names, (std::set<std::string>{"bc", "ma-bcq", "omar", "cql", "madt", "rmadt", "sct"}));
  EXPECT_EQ(parse_learner("MA_BCQ"), LearnerKind::ma_bcq);
  EXPECT_EQ(parse_learner("mabcq"), LearnerKind::ma_bcq);
  expect_error<UsageError>([] { parse_learner("bq\n"); },
                           "'bq?' is no learner: expected bc, ma-bcq, omar, cql, madt, rmadt, sct");
  expect_error<UsageError>([] { parse_learner(""); }, "'' is no learner");
  for (const auto budget : {Budget::smoke, Budget::small, Budget::paper})
    EXPECT_EQ(parse_budget(to_string(budget)), budget);
  EXPECT_EQ(to_string(Budget::smoke), "smoke");
  EXPECT_EQ(to_string(Budget::small), "small");
  EXPECT_EQ(to_string(Budget::paper), "paper");
  expect_error<UsageError>([] { parse_budget("large"); }, "'large' is no budget: expected smoke, small, paper");
}

TEST(Learners, LearnUnderTheirNames) {
  std::set<std::string> policies;
  for (const auto kind : learner_kinds) {
    const auto learner = make_learner(small_data(), choice_of(kind));
    EXPECT_EQ(learner->steps(), 0U);
    const auto losses = learner->step();
    EXPECT_FALSE(losses.empty());
    for (const auto& loss : losses) EXPECT_TRUE(std::isfinite(loss.value)) << to_string(kind) << ", " << loss.name;
    EXPECT_EQ(learner->steps(), 1U);
    const auto bytes = learner->policy({{"learner", std::string(to_string(kind))}});
    const auto controller = any_policy_controller("p", bytes, "p", Side::predators, Scenario::named("simple_tag"));
    EXPECT_EQ(controller.team(Layout(Scenario::named("simple_tag")), Side::predators).size(), 3U);
    EXPECT_EQ(is_transformer(bytes, "p"),
              kind == LearnerKind::sct || kind == LearnerKind::madt || kind == LearnerKind::rmadt);
    EXPECT_TRUE(policies.insert(bytes).second);
  }
}

// ---- settings ----------------------------------------------------------------------------------------------------

struct Setting {
  const char* name;
  std::function<void(LearnerChoice&)> give;
  std::set<LearnerKind> takers;
};

std::vector<Setting> settings() {
  using enum LearnerKind;
  const std::set<LearnerKind> transformers{madt, rmadt, LearnerKind::sct};
  std::set<LearnerKind> layered = transformers;
  layered.insert(bc);
  const std::set<LearnerKind> all(learner_kinds.begin(), learner_kinds.end());
  return {{"hidden", [](auto& c) { c.hidden = 8; }, all},
          {"layers", [](auto& c) { c.layers = 2; }, layered},
          {"batch", [](auto& c) { c.batch = 10; }, all},
          {"learning-rate", [](auto& c) { c.learning_rate = 5e-4; }, all},
          {"dropout", [](auto& c) { c.dropout = 0.25; }, layered},
          {"loss", [](auto& c) { c.loss = sct::LossMode::selfconf; }, {LearnerKind::sct}},
          {"readout", [](auto& c) { c.readout = sct::Readout::token; }, {LearnerKind::sct}},
          {"conservatism", [](auto& c) { c.conservatism = 2; }, {omar, cql}},
          {"imitation", [](auto& c) { c.imitation = 0.25; }, {omar}}};
}

TEST(LearnerSettings, OfOthersAreRefusedByName) {
  for (const auto& setting : settings())
    for (const auto kind : learner_kinds) {
      auto choice = choice_of(kind);
      setting.give(choice);
      if (setting.takers.contains(kind))
        EXPECT_NE(make_learner(small_data(), choice)->description(),
                  make_learner(small_data(), choice_of(kind))->description())
            << setting.name << " of " << to_string(kind);
      else
        expect_error<UsageError>(
            [&] { make_learner(small_data(), choice); },
            fmt::format("{}: {} has no such setting; leave it out", setting.name, to_string(kind)));
    }
}

TEST(LearnerSettings, OutOfRangeAreRefusedByName) {
  const auto refused = [](LearnerKind kind, const char* name, const std::function<void(LearnerChoice&)>& give) {
    auto choice = choice_of(kind);
    give(choice);
    expect_error<UsageError>([&] { make_learner(small_data(), choice); }, name);
  };
  for (const auto kind : learner_kinds) {
    refused(kind, "hidden", [](auto& c) { c.hidden = 0; });
    refused(kind, "batch", [](auto& c) { c.batch = 0; });
    for (const double bad : {0.0, -1.0, std::nan("")})
      refused(kind, "learning-rate", [&](auto& c) { c.learning_rate = bad; });
  }
  for (const auto kind : {LearnerKind::bc, LearnerKind::madt, LearnerKind::rmadt, LearnerKind::sct}) {
    refused(kind, "layers", [](auto& c) { c.layers = 0; });
    for (const double bad : {1.0, -0.1, std::nan("")}) refused(kind, "dropout", [&](auto& c) { c.dropout = bad; });
  }
  refused(LearnerKind::cql, "conservatism", [](auto& c) { c.conservatism = -1; });
  refused(LearnerKind::omar, "imitation", [](auto& c) { c.imitation = 2; });
  for (const auto& [loss, readout] :
       {std::pair(sct::LossMode::action_only, sct::Readout::cat), std::pair(sct::LossMode::teacher, sct::Readout::own)})
    refused(LearnerKind::sct, "sct acts on a belief: without one it is madt (no belief) or rmadt (own readout)",
            [loss = loss, readout = readout](auto& c) { c.loss = loss, c.readout = readout; });
}

TEST(LearnerSettings, OfSctAreLossAndReadout) {
  for (const auto loss : {sct::LossMode::teacher, sct::LossMode::selfconf, sct::LossMode::composite})
    for (const auto readout : {sct::Readout::token, sct::Readout::cat, sct::Readout::add}) {
      auto choice = choice_of(LearnerKind::sct);
      choice.loss = loss;
      choice.readout = readout;
      const auto learner = make_learner(small_data(), choice);
      EXPECT_EQ(said(*learner, "loss"), to_string(loss));
      EXPECT_EQ(said(*learner, "readout"), to_string(readout));
      EXPECT_EQ(said(*learner, "belief-token"), "true");
    }
  const auto madt = make_learner(small_data(), choice_of(LearnerKind::madt));
  EXPECT_EQ(said(*madt, "loss") + said(*madt, "readout") + said(*madt, "belief-token"), "action_onlyownfalse");
  const auto rmadt = make_learner(small_data(), choice_of(LearnerKind::rmadt));
  EXPECT_EQ(said(*rmadt, "loss") + said(*rmadt, "readout") + said(*rmadt, "belief-token"), "teacherowntrue");
}

TEST(LearnerSettings, HaveTheSeed) {
  for (const auto kind : learner_kinds) {
    auto choice = choice_of(kind);
    choice.seed = 77;
    EXPECT_EQ(said(*make_learner(small_data(), choice), "seed"), "77") << to_string(kind);
  }
}

// ---- budgets -----------------------------------------------------------------------------------------------------

TEST(LearnerBudget, OfThePaperIsWhatTheSourcesSay) {
  const auto by_paper = [](LearnerKind kind) {
    auto choice = choice_of(kind, Budget::paper);
    choice.batch.reset();
    return make_learner(small_data(), choice);
  };
  for (const auto kind : {LearnerKind::madt, LearnerKind::rmadt, LearnerKind::sct}) {
    const auto learner = by_paper(kind);
    for (const auto& [key, value] :
         {std::pair("hidden", "128"), std::pair("layers", "3"), std::pair("batch", "64"), std::pair("context", "20"),
          std::pair("learning-rate", "0.0001"), std::pair("warmup", "10000"), std::pair("decay-steps", "0")})
      EXPECT_EQ(said(*learner, key), value) << to_string(kind) << ", " << key;
  }
  EXPECT_EQ(said(*by_paper(LearnerKind::bc), "hidden"), "128");
  EXPECT_EQ(said(*by_paper(LearnerKind::ma_bcq), "vae-hidden"), "750");
  const auto steps = [](LearnerKind kind, const char* level) {
    auto choice = choice_of(kind, Budget::paper);
    choice.level = level;
    return learner_steps(small_data(), choice);
  };
  for (const auto kind : {LearnerKind::madt, LearnerKind::rmadt, LearnerKind::sct}) {
    EXPECT_EQ(steps(kind, "random"), 100'000U);
    EXPECT_EQ(steps(kind, "medium"), 10'000U);
    EXPECT_EQ(steps(kind, "expert"), 10'000U);
  }
  EXPECT_EQ(steps(LearnerKind::bc, "expert"), 150'000U);
  EXPECT_EQ(steps(LearnerKind::ma_bcq, "expert"), 1'000'000U);
  for (const auto kind : {LearnerKind::omar, LearnerKind::cql})
    for (const char* level : {"random", "medium-replay", "medium", "expert"})
      EXPECT_EQ(steps(kind, level), published_omar_steps("simple_tag", level));
}

TEST(LearnerBudget, GrowsFromSmokeToPaper) {
  for (const auto kind : learner_kinds) {
    const auto steps = [&](Budget budget) { return learner_steps(small_data(), choice_of(kind, budget)); };
    EXPECT_EQ(steps(Budget::smoke), 10U);
    EXPECT_LT(steps(Budget::smoke), steps(Budget::small)) << to_string(kind);
    EXPECT_LE(steps(Budget::small), steps(Budget::paper)) << to_string(kind);
    auto choice = choice_of(kind, Budget::small);
    choice.steps = 123;
    EXPECT_EQ(learner_steps(small_data(), choice), 123U);
  }
}

/// Where the rate falls, it falls to the end of the run.
TEST(LearnerBudget, LetsTheRateFallToTheEnd) {
  for (const auto kind : {LearnerKind::bc, LearnerKind::madt, LearnerKind::rmadt, LearnerKind::sct})
    for (const auto budget : {Budget::smoke, Budget::small}) {
      auto choice = choice_of(kind, budget);
      EXPECT_EQ(said(*make_learner(small_data(), choice), "decay-steps"),
                fmt::to_string(learner_steps(small_data(), choice)));
      choice.steps = 77;
      EXPECT_EQ(said(*make_learner(small_data(), choice), "decay-steps"), "77");
    }
}

// ---- levels ------------------------------------------------------------------------------------------------------

TEST(LearnerLevel, ChoosesOmarsNumbers) {
  for (const char* scenario : {"simple_tag", "simple_world"})
    for (const char* level : {"random", "medium-replay", "medium", "expert"}) {
      const SmallData small({}, scenario);
      const auto data = small.data();
      const auto expected = OmarSettings::published(scenario, level);
      for (const auto kind : {LearnerKind::omar, LearnerKind::cql}) {
        auto choice = choice_of(kind);
        choice.level = level;
        const auto learner = make_learner(data, choice);
        EXPECT_EQ(said(*learner, "conservatism"), fmt::format("{}", expected.conservatism));
        EXPECT_EQ(said(*learner, "imitation"),
                  kind == LearnerKind::cql ? "nothing" : fmt::format("{}", expected.imitation));
      }
    }
  auto choice = choice_of(LearnerKind::omar);
  choice.level = "best";
  expect_error<UsageError>([&] { make_learner(small_data(), choice); }, "level 'best'");
}

TEST(LearnerLevel, IsTheDatasUnlessItIsGiven) {
  const auto steps = [](const std::string& of_data, std::optional<std::string> given) {
    const SmallData small(of_data);
    const auto data = small.data();
    auto choice = choice_of(LearnerKind::sct, Budget::paper);
    choice.level = std::move(given);
    return learner_steps(data, choice);
  };
  EXPECT_EQ(steps("random", std::nullopt), 100'000U);
  EXPECT_EQ(steps("medium", std::nullopt), 10'000U);
  EXPECT_EQ(steps("random", "medium"), 10'000U);
  EXPECT_EQ(steps("medium", "random"), 100'000U);
  EXPECT_EQ(steps("", "random"), 100'000U);
}

TEST(LearnerLevel, MustBeKnownWhereNumbersAreChosenByIt) {
  const auto choice_without = [](LearnerKind kind, Budget budget) {
    auto choice = choice_of(kind, budget);
    choice.level.reset();
    return choice;
  };
  for (const auto kind : learner_kinds)
    for (const auto budget : {Budget::smoke, Budget::small, Budget::paper}) {
      const auto choice = choice_without(kind, budget);
      const std::string part = fmt::format(
          "the data do not say their level, by which {}'s numbers are chosen; give --level", to_string(kind));
      const bool omar = kind == LearnerKind::omar || kind == LearnerKind::cql;
      const bool transformer = !omar && kind != LearnerKind::bc && kind != LearnerKind::ma_bcq;
      if ((omar && budget != Budget::smoke) || (transformer && budget == Budget::paper))
        expect_error<UsageError>([&] { learner_steps(small_data(), choice); }, part);
      else
        EXPECT_GT(learner_steps(small_data(), choice), 0U) << to_string(kind);
      if (omar) expect_error<UsageError>([&] { make_learner(small_data(), choice); }, part);
    }
  const SmallData said("medium");
  const auto data = said.data();
  EXPECT_EQ(learner_steps(data, choice_without(LearnerKind::omar, Budget::paper)),
            published_omar_steps("simple_tag", "medium"));
}

// ---- runs --------------------------------------------------------------------------------------------------------

TEST(LearnerRun, SaysWhichDataLearnerAndSettings) {
  const auto choice = choice_of(LearnerKind::sct);
  const auto learner = make_learner(small_data(), choice);
  EXPECT_EQ(run_description(small_data(), choice, *learner),
            fmt::format("data = {:016x}\nscenario = simple_tag\nlearner = sct\n{}",
                        data_figures(small_data()).signature, learner->description()));
}

}  // namespace
}  // namespace folk::mpe
