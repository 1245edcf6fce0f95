#include <folk/games/file_descriptor.h>
#include <folk/strategies/programs/spawn.h>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <string>
#include <system_error>

namespace folk {
namespace {

/// Runs a shell command to its end and returns its wait status.
int status_of(const std::string& command, const StandardStreams& streams = {}) {
  pid_t id = 0;
  const auto error = spawn(id, {"sh", "-c", command}, streams, ProcessGroup::ours);
  EXPECT_FALSE(error) << error.message();
  int status = -1;
  EXPECT_EQ(::waitpid(id, &status, 0), id);
  return status;
}

FileDescriptor scratch_file(const std::string& text = "") {
  FileDescriptor file(::memfd_create("folk-spawn-test", MFD_CLOEXEC));
  EXPECT_EQ(::pwrite(file.get(), text.data(), text.size(), 0), static_cast<ssize_t>(text.size()));
  return file;
}

std::string content(const FileDescriptor& file) {
  std::array<char, 1000> block;
  const ssize_t count = ::pread(file.get(), block.data(), block.size(), 0);
  return std::string(block.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
}

/// A file in the place of one of this process's standard streams for a while; none: the stream is closed.
class Replaced {
public:
  Replaced(int stream, int file)
      : stream_(stream),
        before_(duplicate_above_standard(stream)) {
    if (file >= 0)
      ::dup3(file, stream, O_CLOEXEC);
    else
      ::close(stream);
  }
  ~Replaced() { ::dup2(before_.get(), stream_); }
  Replaced(const Replaced&) = delete;
  Replaced& operator=(const Replaced&) = delete;

private:
  int stream_;
  FileDescriptor before_;
};

const std::string speak = "cat; echo to stdout; echo to stderr >&2";

TEST(Spawn, GivesEachStream) {
  const auto input = scratch_file("input\n");
  const auto output = scratch_file();
  const auto error = scratch_file();
  EXPECT_EQ(status_of(speak, {input.get(), output.get(), error.get()}), 0);
  EXPECT_EQ(content(output), "input\nto stdout\n");
  EXPECT_EQ(content(error), "to stderr\n");
  EXPECT_NE(::fcntl(output.get(), F_GETFD), -1) << "it stays open here";
}

TEST(Spawn, SharesTheOtherStreams) {
  const auto input = scratch_file("input\n");
  const auto output = scratch_file();
  const auto error = scratch_file();
  {
    const Replaced here(STDERR_FILENO, -1);
    ASSERT_EQ(::dup2(error.get(), STDERR_FILENO), STDERR_FILENO);
    EXPECT_EQ(status_of(speak, {input.get(), output.get(), StandardStreams::shared}), 0);
  }
  EXPECT_EQ(content(output), "input\nto stdout\n");
  EXPECT_EQ(content(error), "to stderr\n");
}

TEST(Spawn, TakesStandardDescriptorsInAnyOrder) {
  const std::array files{scratch_file("input\n"), scratch_file(), scratch_file()};
  std::array order{0, 1, 2};  // which of our descriptors holds the child's stdin, stdout, stderr
  do {
    ASSERT_EQ(::ftruncate(files[1].get(), 0) + ::ftruncate(files[2].get(), 0), 0);
    for (const auto& file : files) ::lseek(file.get(), 0, SEEK_SET);
    int status = -1;
    {
      const Replaced stdin_here(order[0], files[0].get());
      const Replaced stdout_here(order[1], files[1].get());
      const Replaced stderr_here(order[2], files[2].get());
      status = status_of(speak, {order[0], order[1], order[2]});
    }
    EXPECT_EQ(status, 0);
    EXPECT_EQ(content(files[1]), "input\nto stdout\n") << order[0] << order[1] << order[2];
    EXPECT_EQ(content(files[2]), "to stderr\n") << order[0] << order[1] << order[2];
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Spawn, PassesArgumentsThroughNoShell) {
  const auto output = scratch_file();
  pid_t id = 0;
  ASSERT_FALSE(spawn(id, {"echo", "a b;$HOME'\""}, {StandardStreams::shared, output.get(), StandardStreams::shared},
                     ProcessGroup::ours));
  ASSERT_EQ(::waitpid(id, nullptr, 0), id);
  EXPECT_EQ(content(output), "a b;$HOME'\"\n");
}

TEST(Spawn, SaysWhyItCannot) {
  pid_t id = 0;
  EXPECT_EQ(spawn(id, {"folk-no-such-program"}, {}, ProcessGroup::ours), std::errc::no_such_file_or_directory);
  EXPECT_EQ(spawn(id, {"/"}, {}, ProcessGroup::ours), std::errc::permission_denied);
  EXPECT_EQ(spawn(id, {"true"}, {1'000'000}, ProcessGroup::ours), std::errc::bad_file_descriptor);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

TEST(Spawn, GivesAProcessGroupOfItsOwnOrOurs) {
  for (const auto group : {ProcessGroup::own, ProcessGroup::ours}) {
    pid_t id = 0;
    ASSERT_FALSE(spawn(id, {"sleep", "1000"}, {}, group));
    EXPECT_EQ(::getpgid(id), group == ProcessGroup::own ? id : ::getpgrp());
    ::kill(id, SIGKILL);
    EXPECT_EQ(::waitpid(id, nullptr, 0), id);
  }
}

TEST(Spawn, ResetsIgnoredAndBlockedSignals) {
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const auto handler = ::signal(SIGPIPE, SIG_IGN);
  const int piped = status_of("kill -PIPE $$");
  const int terminated = status_of("kill -TERM $$");
  ::signal(SIGPIPE, handler);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_TRUE(WIFSIGNALED(piped) && WTERMSIG(piped) == SIGPIPE) << piped;
  EXPECT_TRUE(WIFSIGNALED(terminated) && WTERMSIG(terminated) == SIGTERM) << terminated;
}

}  // namespace
}  // namespace folk
