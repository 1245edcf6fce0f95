#include <folk/games/error.h>
#include <folk/games/match.h>
#include <folk/games/transcript.h>
#include <folk/strategies/programs/child_process.h>
#include <folk/strategies/programs/exec_player.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace folk {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// Tit for tat in the language that every Unix has.
const std::string shell_tit_for_tat =
    "while read -r what own theirs rest; do case $what in"
    " game) answer=C;; round) answer=$theirs;; move) echo $answer;; end) exit 0;; esac; done";

/// Answers everything that wants an answer with the same line.
std::string always(const std::string& line) {
  return "while read -r what rest; do if [ $what = move ]; then echo '" + line + "'; fi; done";
}

/// Of a program that will not answer.
constexpr ProgramRules quick{100ms, 100ms};

std::unique_ptr<Player> started(const std::string& command, const ProgramRules& rules = {}) {
  auto player = exec_strategy({command, rules}).new_player();
  player->start({});
  return player;
}

/// The message with which a player of this command fails within 1000 rounds.
std::string failure(const std::string& command, const ProgramRules& rules = {}) {
  try {
    const auto player = started(command, rules);
    for (int t = 0; t < 1000; ++t) player->observe(player->move(), Move::C);
    player->finish();
  } catch (const EnvironmentError& error) {
    return error.what();
  }
  return "none";
}

#define EXPECT_FAILURE(expected, ...) EXPECT_PRED_FORMAT2(testing::IsSubstring, expected, failure(__VA_ARGS__))

/// `opponent` against the player: the player's moves.
std::string answers(Player& player, const std::string& opponent) {
  std::string moves;
  for (const char theirs : opponent) {
    const Move own = player.move();
    moves += to_char(own);
    player.observe(own, theirs == 'C' ? Move::C : Move::D);
  }
  return moves;
}

/// A file of this test's own, gone at the end.
class TemporaryFile {
public:
  TemporaryFile() {
    std::string pattern = (fs::temp_directory_path() / "folk_exec_XXXXXX").string();
    ::close(::mkstemp(pattern.data()));
    path_ = pattern;
  }
  ~TemporaryFile() { fs::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path() const { return path_.string(); }
  std::string content() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

private:
  fs::path path_;
};

std::size_t open_descriptors() {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
}

bool has_children() { return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

/// The letter of a process's state in /proc; '-' when there is no such process.
char state_of(pid_t id) {
  std::ifstream status(fmt::format("/proc/{}/stat", id));
  std::string line;
  std::getline(status, line);
  const auto name_end = line.rfind(") ");
  return name_end == std::string::npos ? '-' : line.at(name_end + 2);
}

TEST(ParseReply, ReadsMovesAndBeliefs) {
  EXPECT_EQ(parse_reply("C"), (Reply{Move::C, std::nullopt}));
  EXPECT_EQ(parse_reply("D"), (Reply{Move::D, std::nullopt}));
  EXPECT_EQ(parse_reply("C 0.85"), (Reply{Move::C, 0.85}));
  EXPECT_EQ(parse_reply("D\t1"), (Reply{Move::D, 1.0}));
  EXPECT_EQ(parse_reply("D  0 \r"), (Reply{Move::D, 0.0}));
  EXPECT_EQ(parse_reply("C\r"), (Reply{Move::C, std::nullopt}));
  EXPECT_EQ(parse_reply("C 5e-2"), (Reply{Move::C, 0.05}));
}

TEST(ParseReply, RefusesEverythingElse) {
  using namespace std::string_view_literals;
  for (const auto line : {""sv, " "sv, "c"sv, "CC"sv, "C0.5"sv, " C"sv, "C 1.01"sv, "C -0.1"sv, "C nan"sv, "C inf"sv,
                          "C 0.5 0.5"sv, "C 0.5x"sv, "cooperate"sv, "E"sv, "C\0"sv, "C 0,5"sv, "C\n"sv})
    EXPECT_THROW(parse_reply(line), UsageError) << line;
}

TEST(ParseReply, QuotesTheAnswerOnOneLine) {
  try {
    parse_reply("\x1b[31m\nred");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "answer '?[31m?red': expected C or D, then perhaps P(opponent plays C), as in 'C 0.85'");
  }
}

RC_GTEST_PROP(ParseReply, ReadsWhatItWasToldOrThrowsUsageError, (const std::string& line)) {
  try {
    const Reply reply = parse_reply(line);
    RC_ASSERT(line.at(0) == to_char(reply.move));
  } catch (const UsageError&) {
  }
}

RC_GTEST_PROP(ParseReply, ReadsEveryBelief, ()) {
  const double belief = *rc::gen::map(rc::gen::inRange(0, 1'000'000'001), [](int n) { return n / 1e9; });
  RC_ASSERT(parse_reply(fmt::format("D {}", belief)) == (Reply{Move::D, belief}));
}

TEST(ExecStrategy, IsNamedAfterItsCommand) {
  const Strategy strategy = exec_strategy({"python3 player.py"});
  EXPECT_EQ(strategy.name, "exec:\"python3 player.py\"");
  EXPECT_EQ(strategy.machine, nullptr);
}

TEST(ExecStrategy, RefusesCommandsAndTimeOutsThatMakeNoSense) {
  EXPECT_THROW(exec_strategy({""}), UsageError);
  EXPECT_THROW(exec_strategy({"  "}), UsageError);
  EXPECT_THROW(exec_strategy({"a\nb"}), UsageError);
  EXPECT_THROW(exec_strategy({std::string("a\0b", 3)}), UsageError);
  EXPECT_THROW(exec_strategy({"true", {60s, 0ms}}), UsageError);
  EXPECT_THROW(exec_strategy({"true", {60s, -1ms}}), UsageError);
  EXPECT_THROW(exec_strategy({"true", {std::chrono::milliseconds::max(), 60s}}), UsageError);
}

// A program may need long to start, and is to answer fast then.
TEST(ExecPlayer, HasLongerForItsFirstAnswer) {
  const auto player = exec_strategy({"sleep 0.3; " + always("C"), {60s, 100ms}}).new_player();
  player->start({});
  EXPECT_EQ(answers(*player, "CCC"), "CCC");
  EXPECT_FAILURE("silent for 0.1 s", "sleep 100", quick);
  EXPECT_FAILURE("(\"CMD\";start=SECONDS) gives it longer", "sleep 100", quick);
}

TEST(ExecPlayer, IsDeterministicWhereItsUserSaysSo) {
  EXPECT_FALSE(exec_strategy({"true"}).deterministic);
  EXPECT_TRUE(exec_strategy({"true", {60s, 5s, true}}).deterministic);
}

TEST(ExecPlayer, PlaysAndStartsAgain) {
  const auto player = started(shell_tit_for_tat);
  EXPECT_EQ(answers(*player, "CDDCDC"), "CCDDCD");
  EXPECT_FALSE(player->belief().has_value());
  player->start({});
  EXPECT_EQ(answers(*player, "DDC"), "CDD");
}

TEST(ExecPlayer, PlaysAMatchWithAnotherProgram) {
  const auto first = started(shell_tit_for_tat);
  const auto second = started(always("D"));
  Transcript transcript;
  play_match(*first, *second, 50, NoNoise{}, [&](Move a, Move b) { transcript.append(a, b); });
  EXPECT_EQ(transcript.moves(Seat::first), "C" + std::string(49, 'D'));
  EXPECT_EQ(transcript.moves(Seat::second), std::string(50, 'D'));
}

TEST(ExecPlayer, HoldsTheBeliefOfTheLastMove) {
  const auto player = started(
      "n=0; while read -r what rest; do if [ $what = move ]; then n=$((n+1));"
      " if [ $n = 1 ]; then echo C 0.25; else echo D; fi; fi; done");
  player->move();
  EXPECT_EQ(player->belief(), 0.25);
  player->move();
  EXPECT_FALSE(player->belief().has_value());
}

TEST(ExecPlayer, TellsTheProgramEverything) {
  const TemporaryFile heard;
  {
    const auto player = exec_strategy({"while read -r line; do echo \"$line\" >> '" + heard.path() +
                                       "'; if [ \"$line\" = move ]; then echo D; fi; done"})
                            .new_player();
    player->start({Payoffs{}, Criterion::finite(2), RandomKey{}});
    player->observe(player->move(), Move::C);
    player->observe(player->move(), Move::D);
    player->start({Payoffs{Rational(7) / 2, 2, 1, 0}, Criterion::discounted(0.9), RandomKey{}});
  }
  const auto seed = RandomStream(RandomKey{})();
  EXPECT_EQ(heard.content(), fmt::format("game T=5,R=3,P=1,S=0 criterion=finite:2 seed={}\n"
                                         "move\nround D C\nmove\nround D D\n"
                                         "game T=3.5,R=2,P=1,S=0 criterion=discounted:0.9 seed={}\n"
                                         "end\n",
                                         seed, seed));
}

TEST(ExecPlayer, ThePythonExamplePlaysTitForTatWithABelief) {
  if (std::system("python3 -c 'import sys' >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3";
  const auto player = started("python3 '" FOLK_SOURCE_DIR "/examples/tit_for_tat.py'");
  EXPECT_EQ(player->move(), Move::C);
  EXPECT_EQ(player->belief(), 0.5);
  player->observe(Move::C, Move::D);
  EXPECT_EQ(player->move(), Move::D);
  EXPECT_EQ(player->belief(), 1.0 / 3);
  player->observe(Move::D, Move::C);
  EXPECT_EQ(answers(*player, "CDDCDC"), "CCDDCD");
  player->start({});
  EXPECT_EQ(answers(*player, "DC"), "CD");
}

TEST(ExecPlayer, NeedsAStartBeforeAMove) {
  const auto player = exec_strategy({"true"}).new_player();
  EXPECT_THROW(player->move(), std::logic_error);
}

TEST(HostileProgram, ThatEndsAtOnce) {
  EXPECT_EQ(failure("false"),
            "exec:\"false\": ended with exit status 1 in the middle of a match; it must read and answer until the line "
            "'end'");
}

TEST(HostileProgram, ThatDoesNotExist) {
  EXPECT_FAILURE("ended with exit status 127: the shell found no such command; ",
                 "exec 2>/dev/null; folk-no-such-program");
}

TEST(HostileProgram, ThatIsSilent) {
  EXPECT_FAILURE("exec(\"sleep 100\";timeout=0.1;start=0.1): silent for 0.1 s; it must", "sleep 100", quick);
}

TEST(HostileProgram, ThatWritesHalfALineAndIsSilent) {
  EXPECT_FAILURE("silent for 0.1 s", "read -r game; read -r move; printf C; sleep 100", quick);
}

TEST(HostileProgram, ThatWritesNonsenseForEver) { EXPECT_FAILURE("exec:\"yes nonsense\": ", "yes nonsense"); }

TEST(HostileProgram, ThatAnswersNonsense) {
  EXPECT_FAILURE(": answer 'C 7': expected C or D", always("C 7"));
  EXPECT_FAILURE(": answer '': expected C or D", always(""));
}

TEST(HostileProgram, ThatSpeaksUnasked) {
  EXPECT_FAILURE("only the line 'move' wants an answer", "while read -r line; do echo C; done");
}

// However its lines fall between ours: there is one too many at the end.
TEST(HostileProgram, ThatOpensBeforeItIsAsked) {
  const std::string opens =
      "echo C; answer=C; while read -r what own theirs; do case $what in move) echo $answer;;"
      " round) answer=$theirs;; end) exit 0;; esac; done";
  for (int run = 0; run < 10; ++run) EXPECT_FAILURE("only the line 'move' wants an answer", opens);
  const auto player = started("read -r game; read -r move; echo C; read -r end; echo bye");
  player->observe(player->move(), Move::C);
  EXPECT_THROW(player->finish(), EnvironmentError);
}

TEST(HostileProgram, ThatStaysAfterItsEndIsKilled) {
  const TemporaryFile id;
  const auto player = started("echo $$ > '" + id.path() + "'; " + always("C") + "; sleep 1000");
  EXPECT_EQ(player->move(), Move::C);
  player->finish();
  EXPECT_EQ(state_of(std::stoi(id.content())), '-');
  player->finish();  // there is nobody to tell
}

TEST(HostileProgram, ThatLeavesItsGroupIsKilled) {
  if (std::system("python3 -c 'import sys' >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3";
  const TemporaryFile ids;
  {
    const auto player = started(
        "python3 -c 'import os, subprocess, time; os.setpgid(0, os.getpgid(os.getppid()));"
        " other = subprocess.Popen([\"sleep\", \"1000\"], start_new_session=True);"
        " open(\"" +
        ids.path() +
        "\", \"w\").write(f\"{os.getpid()} {other.pid}\");"
        " input(); input(); print(\"C\", flush=True); time.sleep(1000)'");
    EXPECT_EQ(player->move(), Move::C);
  }
  std::ifstream file(ids.path());
  for (pid_t id = 0; file >> id;)
    while (state_of(id) != 'Z' && state_of(id) != '-') std::this_thread::sleep_for(1ms);
}

TEST(HostileProgram, ThatEndsAfterThreeMoves) {
  const std::string command = "for i in 1 2 3; do read -r a; read -r b; echo C; done; exit 3";
  const auto player = started(command);
  EXPECT_EQ(answers(*player, "CCC"), "CCC");
  EXPECT_THROW(player->move(), EnvironmentError);
  player->start({});  // a fresh program
  EXPECT_EQ(answers(*player, "DDD"), "CCC");
  EXPECT_FAILURE("ended with exit status 3 in the middle", command);
}

TEST(HostileProgram, ThatIsKilled) { EXPECT_FAILURE("was killed by SIGKILL", "kill -9 $$"); }

TEST(HostileProgram, ThatClosesItsOutput) {
  EXPECT_FAILURE("closed its input or output", "exec >/dev/null; while read -r line; do :; done; sleep 100");
}

TEST(HostileProgram, ThatWritesAHugeLine) {
  EXPECT_FAILURE("wrote a line of more than 4096 bytes",
                 "read -r game; read -r move; head -c 1000000 /dev/zero | tr '\\0' C; sleep 100");
}

TEST(HostileProgram, ThatNeverReads) {
  const auto player = started("sleep 100", quick);
  for (int t = 0; t < 100'000; ++t) player->observe(Move::C, Move::C);  // more than a pipe holds
  EXPECT_THROW(
      {
        try {
          player->move();
        } catch (const EnvironmentError& error) {
          EXPECT_PRED_FORMAT2(testing::IsSubstring, "read nothing for 0.1 s", error.what());
          throw;
        }
      },
      EnvironmentError);
}

TEST(ChildProcess, AReaderThatIsGoneRaisesNoSignal) {
  sigset_t before;
  sigset_t after;
  ::pthread_sigmask(SIG_BLOCK, nullptr, &before);
  ChildProcess child("child", "exec <&-; sleep 100");
  EXPECT_THROW(
      {
        for (int i = 0; i < 1'000'000; ++i) child.send("x\n", 60s);
      },
      EnvironmentError);
  child.abandon();
  ::pthread_sigmask(SIG_BLOCK, nullptr, &after);
  for (int signal = 1; signal < 32; ++signal) EXPECT_EQ(sigismember(&before, signal), sigismember(&after, signal));
  sigset_t pending;
  ::sigpending(&pending);
  EXPECT_EQ(sigismember(&pending, SIGPIPE), 0);
}

TEST(ChildProcess, ALineMayHave4096Bytes) {
  ChildProcess child("child", "head -c 4096 /dev/zero | tr '\\0' x; echo; head -c 4097 /dev/zero | tr '\\0' x; echo");
  EXPECT_EQ(child.receive(60s), std::string(4096, 'x'));
  EXPECT_THROW(child.receive(60s), EnvironmentError);
}

TEST(ChildProcess, LeavesNoDescriptorAndNoZombie) {
  failure("false");  // what is opened once for all
  const auto before = open_descriptors();
  for (int i = 0; i < 5; ++i) {
    const auto player = started(shell_tit_for_tat);
    EXPECT_EQ(answers(*player, "CD"), "CC");
    EXPECT_EQ(open_descriptors(), before + 2);
    failure("false");
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, InheritsNoDescriptorOfAnotherChild) {
  const std::string command = "ls /proc/self/fd | tr '\\n' ' '; echo";
  const std::string alone = ChildProcess("child", command).receive(60s);
  const auto other = started(shell_tit_for_tat);
  other->move();
  EXPECT_EQ(ChildProcess("child", command).receive(60s), alone);
}

TEST(ChildProcess, TakesItsProcessGroupAlong) {
  const TemporaryFile ids;
  {
    const auto player = started("sleep 1000 & echo $! $$ > '" + ids.path() + "'; " + always("C"));
    EXPECT_EQ(player->move(), Move::C);
  }
  std::ifstream file(ids.path());
  pid_t leader = 0;
  pid_t member = 0;
  ASSERT_TRUE(file >> member >> leader);
  EXPECT_EQ(::kill(leader, 0), -1);
  // The signal is on its way when the player is gone; a killed orphan may stay a zombie until init fetches it.
  while (state_of(member) != 'Z' && state_of(member) != '-') std::this_thread::sleep_for(1ms);
}

TEST(ChildProcess, ManyThreadsPlayAtOnce) {
  failure("false");  // what is opened once for all
  const auto before = open_descriptors();
  std::vector<std::thread> threads;
  std::vector<std::string> results(8);
  for (auto& result : results)
    threads.emplace_back([&result] {
      std::vector<std::unique_ptr<Player>> players;
      for (int i = 0; i < 4; ++i) players.push_back(started(shell_tit_for_tat));
      for (const auto& player : players) result += answers(*player, "CDDCDC");
      result += failure("exit 5").substr(0, 14);
    });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, "CCDDCDCCDDCDCCDDCDCCDDCDexec:\"exit 5\":");
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_FALSE(has_children());
}

}  // namespace
}  // namespace folk
