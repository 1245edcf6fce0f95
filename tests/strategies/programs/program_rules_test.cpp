#include <folk/games/error.h>
#include <folk/strategies/programs/program_rules.h>
#include <folk/strategies/registry.h>

#include <gtest/gtest.h>

#include <string>

#include "games/expect_error.h"

namespace folk {
namespace {

using namespace std::chrono_literals;

TEST(ProgramCall, IsReadInBothForms) {
  EXPECT_EQ(parse_program_call(":\"./player 1\""), (ProgramCall{"./player 1", {}}));
  EXPECT_EQ(parse_program_call(":./player"), (ProgramCall{"./player", {}}));
  EXPECT_EQ(parse_program_call(":\"echo \\\"a\\\" \\\\ b\""), (ProgramCall{"echo \"a\" \\ b", {}}));
  EXPECT_EQ(parse_program_call("(\"./player\")"), (ProgramCall{"./player", {}}));
  EXPECT_EQ(parse_program_call("(\"a;b\\\")\";timeout=60;start=120;deterministic)"),
            (ProgramCall{"a;b\")", {120s, 60s, true}}));
  EXPECT_EQ(parse_program_call("(\"x\" ; deterministic ; timeout=0.25 )"), (ProgramCall{"x", {60s, 250ms, true}}));
  EXPECT_EQ(parse_program_call("(\"x\";timeout=300)").rules, (ProgramRules{300s, 300s, false}));
}

TEST(ProgramCall, IsReadBackFromItsName) {
  for (const ProgramCall& call : {ProgramCall{"a", {}}, ProgramCall{"a\"b\\c", {}}, ProgramCall{"x", {60s, 5s, true}},
                                  ProgramCall{"x", {61s, 5s, true}}, ProgramCall{"x;y)", {300s, 300s, false}},
                                  ProgramCall{"x", {300s, 100s, false}}, ProgramCall{"x", {1500ms, 1ms, true}}})
    EXPECT_EQ(parse_program_call(to_string(call).substr(4)), call) << to_string(call);
  EXPECT_EQ(to_string(ProgramCall{"a \"b\"", {}}), "exec:\"a \\\"b\\\"\"");
  EXPECT_EQ(to_string(ProgramCall{"x", {120s, 60s, true}}), "exec(\"x\";timeout=60;start=120;deterministic)");
}

TEST(ProgramCall, IsRefusedInALine) {
  const auto refused = [](const std::string& text, const std::string& words) {
    test::expect_error<UsageError>([&] { parse_program_call(text); }, words);
  };
  for (const char* text : {":", ":\"\"", ":   ", "(\" \")"}) refused(text, "exec: has no command");
  for (const char* text : {"", "()", "(x)", "(\"x)", "(\"x\"", "(\"x\")y", "(\"x\"y)", "(\"x\\\")"})
    refused(text, "expected exec:\"CMD\" or exec(");
  for (const char* setting : {"", "x", "time=3", "deterministic=1", "TIMEOUT=3"})
    refused(std::string("(\"x\";") + setting + ")", "expected timeout=SECONDS, start=SECONDS or deterministic");
  for (const char* number : {"", "0", "-1", "nan", "inf", "1e9", "x", "86401", "0.0001"})
    refused(std::string("(\"x\";timeout=") + number + ")", "timeout in seconds");
  for (const char* setting : {"timeout=3", "start=30", "deterministic"})
    refused(std::string("(\"x\";") + setting + ";" + setting + ")", "is given twice");
  refused("(\"x\";timeout=30;start=20)", "start=20 is less than timeout=30");
  refused(":a\nb", "exec: command 'a?b' has control characters");
}

TEST(ProgramCall, StandsInARoster) {
  const auto roster = Registry::standard().roster("exec(\"a, (b\";deterministic),exec:\"c\",pavlov", {});
  ASSERT_EQ(roster.size(), 3U);
  EXPECT_EQ(roster[0].name, "exec(\"a, (b\";deterministic)");
  EXPECT_TRUE(roster[0].deterministic);
  EXPECT_EQ(roster[1].name, "exec:\"c\"");
}

}  // namespace
}  // namespace folk
