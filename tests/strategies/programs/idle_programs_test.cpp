#include "games/expect_error.h"

#include <folk/games/error.h>
#include <folk/strategies/programs/asked_program.h>
#include <folk/strategies/programs/idle_programs.h>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace folk {
namespace {

using namespace std::chrono_literals;

/// A program that notes each start in a file, and answers "C" to every move.
class CountedProgram {
public:
  CountedProgram() {
    std::string pattern = (std::filesystem::temp_directory_path() / "folk_idle_XXXXXX").string();
    ::close(::mkstemp(pattern.data()));
    path_ = pattern;
  }
  ~CountedProgram() { std::filesystem::remove(path_); }
  CountedProgram(const CountedProgram&) = delete;
  CountedProgram& operator=(const CountedProgram&) = delete;

  /// `more` is what it does, beside the answer, at a move; `$n` counts them.
  ProgramCall call(const std::string& more = ":") const {
    return {"echo started >> " + path_.string() +
            "; n=0; while read -r what rest; do case $what in move) n=$((n+1)); echo C; " + more +
            ";; end) exit 0;; esac; done"};
  }
  int starts() const {
    std::ifstream file(path_);
    int lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    return lines;
  }

private:
  std::filesystem::path path_;
};

bool is_child_left() { return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

std::string as_it_is(const std::string& text) { return text; }

/// One match of a few moves by a player of its own.
void play_match(const ProgramCall& call, const std::shared_ptr<IdlePrograms>& idle, int moves = 2) {
  AskedProgram program(call, "move", idle);
  program.run();
  program.tell("game");
  for (int t = 0; t < moves; ++t) {
    EXPECT_EQ(program.ask("move", as_it_is), "C");
    program.tell("round C C");
  }
  program.finish();
}

TEST(IdlePrograms, ALongStartIsMadeOnceForAllPlayersOneAfterAnother) {
  const CountedProgram program;
  auto idle = std::make_shared<IdlePrograms>(0ms);  // any start is long
  for (int match = 0; match < 3; ++match) play_match(program.call(), idle);
  EXPECT_EQ(program.starts(), 1);
  idle.reset();
  EXPECT_FALSE(is_child_left());
}

TEST(IdlePrograms, AShortStartIsMadeForEachPlayer) {
  const CountedProgram program;
  const auto idle = std::make_shared<IdlePrograms>(1h);
  for (int match = 0; match < 3; ++match) play_match(program.call(), idle);
  EXPECT_EQ(program.starts(), 3);
  EXPECT_FALSE(is_child_left());
}

TEST(IdlePrograms, WhatIsSaidUnaskedIsFoundAtTheEndOfTheMatchInWhichItIsSaid) {
  const CountedProgram program;
  const auto idle = std::make_shared<IdlePrograms>(0ms);
  play_match(program.call("[ $n = 4 ] && echo D"), idle);
  test::expect_error<EnvironmentError>([&] { play_match(program.call("[ $n = 4 ] && echo D"), idle); },
                                       "wrote more lines than it was asked for");
  play_match(program.call(), idle);  // with a fresh one
  EXPECT_EQ(program.starts(), 2);
}

TEST(IdlePrograms, WhatIsSaidWhileItWaitsIsFoundBeforeTheNextMatch) {
  const CountedProgram program;
  const auto idle = std::make_shared<IdlePrograms>(0ms);
  const ProgramCall call = program.call("[ $n = 2 ] && { sleep 0.3; echo D; }");
  play_match(call, idle);
  std::this_thread::sleep_for(200ms);
  test::expect_error<EnvironmentError>([&] { play_match(call, idle); }, "wrote more lines than it was asked for");
}

TEST(IdlePrograms, OneThatEndsAfterItsMatchIsStartedAnew) {
  const CountedProgram program;
  const auto idle = std::make_shared<IdlePrograms>(0ms);
  for (int match = 0; match < 3; ++match) play_match(program.call("[ $n = 2 ] && exit 0"), idle);
  EXPECT_EQ(program.starts(), 3);
}

TEST(IdlePrograms, ThreadsShareThemAndNoneIsKeptBeyondTheBound) {
  const CountedProgram program;
  auto idle = std::make_shared<IdlePrograms>(0ms);
  const ProgramCall call = program.call();
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int match = 0; match < 2; ++match) play_match(call, idle);
    });
  for (auto& thread : threads) thread.join();
  EXPECT_LE(program.starts(), 4);
  for (std::size_t i = 0; i < IdlePrograms::most + 3; ++i)
    idle->give(std::make_unique<ChildProcess>("many", "while read -r line; do [ $line = end ] && exit 0; done"));
  std::size_t kept = 0;
  while (idle->take()) ++kept;
  EXPECT_EQ(kept, IdlePrograms::most);
  idle.reset();
  EXPECT_FALSE(is_child_left());
}

}  // namespace
}  // namespace folk
