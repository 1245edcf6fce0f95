#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/strategies/machine_text.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace folk {
namespace {

using Node = Automaton::Node;

const Automaton tit_for_tat({{1, {0, 1, 0, 1}}, {0, {0, 1, 0, 1}}}, 0);
const Automaton grim({{1, {0, 1, 1, 1}}, {0, {1, 1, 1, 1}}}, 0);

std::string fault(std::string_view text) {
  try {
    read_machines(text, "my.machines");
  } catch (const InputFileError& error) {
    return error.what();
  }
  return "accepted";
}

std::string line_fault(std::string_view line) {
  try {
    read_machine_line(line);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

#define EXPECT_FAULT(text, expected) EXPECT_PRED_FORMAT2(testing::IsSubstring, expected, fault(text))

TEST(ReadMachines, ReadsTwoAndFourSuccessors) {
  const auto machines = read_machines(
      "# comment\n"
      "machine my_tft # another\n"
      "c\tC c  d\n"
      "\n"
      "  d D c d#no blank before\n"
      "machine my_grim\n"
      "ok C ok bad bad bad\n"
      "bad D bad bad\n",
      "my.machines");
  ASSERT_EQ(machines.size(), 2U);
  EXPECT_EQ(machines[0].name, "my_tft");
  EXPECT_EQ(machines[0].machine, tit_for_tat);
  EXPECT_EQ(machines[1].name, "my_grim");
  EXPECT_EQ(machines[1].machine, grim);
}

TEST(ReadMachines, StartLineOverridesTheFirstState) {
  for (const char* text : {"machine x\nstart d\nc C c d\nd D c d", "machine x\nc C c d\nd D c d\nstart d"}) {
    const auto machines = read_machines(text, "x");
    EXPECT_EQ(machines.at(0).machine.start(), 1U);
    EXPECT_EQ(machines[0].machine.nodes(), tit_for_tat.nodes());
  }
}

TEST(ReadMachines, ReadsProbabilities) {
  const auto machines = read_machines("machine x\na 0.3 a b\nb 1e-3 a c\nc 1 a d\nd 0 a a", "x");
  const auto& nodes = machines.at(0).machine.nodes();
  EXPECT_EQ(nodes[0].cooperation, 0.3);
  EXPECT_EQ(nodes[1].cooperation, 1e-3);
  EXPECT_EQ(nodes[2].cooperation, 1.0);
  EXPECT_EQ(nodes[3].cooperation, 0.0);
  EXPECT_FALSE(machines[0].machine.deterministic());
}

TEST(ReadMachines, ReadsFractions) {
  const auto machines = read_machines("machine x\na 1/3 a b\nb 2/2 a a", "x");
  EXPECT_EQ(machines.at(0).machine.nodes()[0].cooperation, 1.0 / 3);
  EXPECT_EQ(machines[0].machine.nodes()[1].cooperation, 1.0);
  EXPECT_EQ(read_machines(write_machine("x", machines[0].machine), "x").at(0).machine, machines[0].machine);
  for (const char* move : {"4/3", "1/0", "-1/3", "1/", "1e999999999"})
    EXPECT_FAULT(fmt::format("machine x\nc {} c c", move), fmt::format("my.machines:2: move '{}': expected", move));
}

TEST(ReadMachines, AcceptsWindowsLineEndsByteOrderMarkAndSemicolons) {
  EXPECT_EQ(read_machines("\xef\xbb\xbfmachine x\r\nc C c d\r\nd D c d", "x").at(0).machine, tit_for_tat);
  EXPECT_EQ(read_machines("machine x; c C c d; d D c d; # ; is no end of a comment\n", "x").at(0).machine, tit_for_tat);
}

TEST(ReadMachines, CommentsMayBeInAnyLanguage) {
  EXPECT_EQ(fault("# na\xc3\xafve \xe5\x9b\x9a\nmachine x\nc C c c"), "accepted");
}

TEST(ReadMachines, FaultsNameTheLine) {
  EXPECT_EQ(fault("machine x\nc C c dd\n"), "my.machines:2: unknown state 'dd'; list it in this machine");
  EXPECT_EQ(fault("machine x\nc C c c\n\nc D c c\n"),
            "my.machines:4: state 'c' is already in line 2; rename one of them");
  EXPECT_EQ(fault("machine My_TFT\nc C c c\n# comment\nmachine mytft\nc C c c"),
            "my.machines:4: machine 'mytft' has the name of the one in line 1 (case, _ and - do not count); rename one "
            "of them");
  EXPECT_EQ(fault("machine x\n\nmachine y\nc C c c"), "my.machines:1: machine 'x' has no state; list one as 'c C c c'");
  EXPECT_EQ(fault(""), "my.machines:1: no machine in this file; begin a block with 'machine NAME'");
  EXPECT_EQ(fault("\nc C c d"),
            "my.machines:2: 'c' stands before the first machine; begin a block with 'machine NAME'");
}

TEST(ReadMachines, RefusesWrongNumbersOfSuccessors) {
  for (const char* line : {"c", "c C", "c C c", "c C c c c", "c C c c c c c", "c C c c c c c c c c c c"})
    EXPECT_FAULT(std::string("machine x\n") + line, "my.machines:2: state 'c': expected a move and two successors");
}

TEST(ReadMachines, RefusesWhatIsNoMove) {
  for (const char* move :
       {"c", "CC", "1.5", "-0.1", "nan", "NaN", "inf", "-inf", "1e", "0x1p-1", "0.5.5", "1e999", "+1"})
    EXPECT_FAULT(fmt::format("machine x\nc {} c c", move), fmt::format("my.machines:2: move '{}': expected", move));
}

TEST(ReadMachines, RefusesNamesThatARosterCannotHold) {
  for (const char* name :
       {"@x", "a,b", "gtft(0.3)", "exec:x", "'x'", "a/b", "_x", "-x", "+x", ".x", "_", "caf\xc3\xa9"})
    EXPECT_FAULT(fmt::format("machine {}\nc C c c", name), "is no name of a machine; ");
  EXPECT_FAULT("machine two words\nc C c c", "my.machines:1: expected 'machine NAME'");
  EXPECT_FAULT("machine\nc C c c", "my.machines:1: expected 'machine NAME'");
  EXPECT_EQ(fault("machine " + std::string(100, 'x') + "\nc C c c"), "accepted");
  EXPECT_FAULT("machine " + std::string(101, 'x') + "\nc C c c", "longer than 100 characters");
}

TEST(ReadMachines, RefusesStateNamesThatAreWordsOfTheForm) {
  EXPECT_FAULT("machine x\nstart C start start", "expected 'start STATE'");
  EXPECT_FAULT("machine x\nc C c c\nmachine C c c", "my.machines:3: expected 'machine NAME'");
  EXPECT_FAULT("machine x\n(c) C (c) (c)", "my.machines:2: '(c)' is no name of a state");
}

TEST(ReadMachines, RefusesStartsThatMakeNoSense) {
  EXPECT_FAULT("machine x\nc C c c\nstart e", "my.machines:3: unknown state 'e'");
  EXPECT_FAULT("machine x\nstart c\nc C c c\nstart c", "my.machines:4: a second start; line 2 gives the first");
  EXPECT_FAULT("machine x\nstart\nc C c c", "my.machines:2: ");
  EXPECT_FAULT("start c\nmachine x\nc C c c", "my.machines:1: ");
}

TEST(ReadMachines, RefusesControlCharacters) {
  using namespace std::string_view_literals;
  EXPECT_EQ(fault("machine x\nc C\0 c c"sv), "my.machines:2: control character 0x00; a machine file is plain text");
  EXPECT_FAULT("machine x\n# \x1b[31m\nc C c c", "my.machines:2: control character 0x1b");
  EXPECT_FAULT("machine x\rc C c c", "my.machines:1: control character 0x0d");
  EXPECT_FAULT("machine x\x7f", "my.machines:1: control character 0x7f");
}

TEST(ReadMachines, MessagesStayShortAndOnOneLine) {
  const std::string message = fault("machine x\nc " + std::string(100'000, '\xff') + " c c");
  EXPECT_LT(message.size(), 400U);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(ReadMachines, RefusesMoreThanAMillionStates) {
  std::string text = "machine big\n";
  for (std::size_t i = 0; i < most_written_states; ++i) text += fmt::format("s{} C s0 s0\n", i);
  text += "one_more C s0 s0\n";
  EXPECT_FAULT(text, "my.machines:1000002: more than 1000000 states");
}

TEST(ReadMachines, ReadsTheExample) {
  const std::string path = FOLK_SOURCE_DIR "/examples/my_strategies.machines";
  const auto machines = read_machines(read_text_file(path), path);
  ASSERT_EQ(machines.size(), 3U);
  EXPECT_TRUE(machines[0].machine.deterministic());
  const auto& four = machines[1].machine.nodes().at(1).next;
  EXPECT_TRUE(four[0] != four[2] || four[1] != four[3]);
  EXPECT_FALSE(machines[2].machine.deterministic());
}

TEST(ReadMachineLine, ReadsTheFormOnOneLine) {
  EXPECT_EQ(read_machine_line("c C c d; d D c d"), tit_for_tat);
  EXPECT_EQ(read_machine_line("ok C ok bad bad bad;bad D bad bad;"), grim);
  EXPECT_EQ(read_machine_line("start d; c C c d; d D c d").start(), 1U);
}

TEST(ReadMachineLine, FaultsQuoteTheLine) {
  EXPECT_EQ(line_fault("c C c d"), "machine 'c C c d': unknown state 'd'; list it in this machine");
  EXPECT_EQ(line_fault(""), "machine '': it has no state; list one as 'c C c c'");
  EXPECT_NE(line_fault("machine x; c C c c"), "accepted");
}

TEST(WriteMachine, WritesReadableNamesInAlignedColumns) {
  EXPECT_EQ(write_machine("my_tft", tit_for_tat),
            "machine my_tft\n"
            "c  C  c d\n"
            "d  D  c d\n");
  EXPECT_EQ(write_machine("grim", grim),
            "machine grim\n"
            "c  C  c d d d\n"
            "d  D  d d\n");
  EXPECT_EQ(write_machine("mixed", Automaton({{0.25, {0, 1, 0, 1}}, {1, {2, 2, 2, 2}}, {1, {0, 1, 2, 2}}}, 2)),
            "machine mixed\n"
            "start c2\n"
            "m   0.25  m  c\n"
            "c   C     c2 c2\n"
            "c2  C     m  c  c2 c2\n");
}

TEST(WriteMachine, ReplacesWhatANameOfTheFormCannotHold) {
  const auto first_line = [](const std::string& name) {
    const std::string text = write_machine(name, grim);
    EXPECT_EQ(fault(text), "accepted") << text;
    return text.substr(8, text.find('\n') - 8);
  };
  EXPECT_EQ(first_line("tit_for_tat"), "tit_for_tat");
  EXPECT_EQ(first_line("gtft(0.3)"), "gtft_0.3");
  EXPECT_EQ(first_line("mem1(c;0.9,0.1,0.8,0.3)"), "mem1_c_0.9_0.1_0.8_0.3");
  EXPECT_EQ(first_line("x_"), "x_");
  EXPECT_EQ(first_line("-@x"), "x");
  EXPECT_EQ(first_line("()"), "unnamed");
  EXPECT_EQ(first_line(""), "unnamed");
  EXPECT_EQ(first_line(std::string(200, 'x')), std::string(100, 'x'));
}

TEST(WriteMachine, RefusesAnUnrolledMachine) {
  EXPECT_THROW(write_machine("x", Automaton({{1, {1, 1, 1, 1}}, {1, {1, 1, 1, 1}}}, 0, 1)), UsageError);
}

double any_cooperation() {
  const double usual = *rc::gen::map(rc::gen::inRange(0, 1'000'000'001), [](int n) { return n / 1e9; });
  return *rc::gen::element(0.0, 1.0, usual, std::nextafter(1.0, 0.0), std::nextafter(usual, 0.0),
                           std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::min(), 1e-300);
}

Automaton any_automaton() {
  const auto size = *rc::gen::inRange<std::uint32_t>(1, 13);
  const auto any_state = rc::gen::inRange<std::uint32_t>(0, size);
  std::vector<Node> nodes(size);
  for (auto& node : nodes) {
    node.cooperation = any_cooperation();
    node.next = {*any_state, *any_state, *any_state, *any_state};
    if (*rc::gen::arbitrary<bool>()) node.next = {node.next[0], node.next[1], node.next[0], node.next[1]};
  }
  return Automaton(std::move(nodes), *any_state);
}

RC_GTEST_PROP(WriteMachine, IsReadBackExactly, ()) {
  const Automaton automaton = any_automaton();
  const auto machines = read_machines(write_machine("x", automaton), "x");
  RC_ASSERT(machines.size() == 1U);
  RC_ASSERT(machines[0].name == "x");
  RC_ASSERT(machines[0].machine == automaton);
}

RC_GTEST_PROP(WriteMachine, WithoutItsNameIsAMachineLine, ()) {
  const Automaton automaton = any_automaton();
  std::string text = write_machine("x", automaton);
  text.erase(0, text.find('\n') + 1);
  for (char& c : text)
    if (c == '\n') c = ';';
  RC_ASSERT(read_machine_line(text) == automaton);
}

RC_GTEST_PROP(WriteMachine, TwoBlocksMakeAFile, ()) {
  const Automaton a = any_automaton();
  const Automaton b = any_automaton();
  const auto machines = read_machines(write_machine("a", a) + write_machine("b", b), "x");
  RC_ASSERT(machines.size() == 2U);
  RC_ASSERT(machines[0].machine == a);
  RC_ASSERT(machines[1].machine == b);
}

}  // namespace
}  // namespace folk
