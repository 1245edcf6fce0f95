#include <folk/games/file_descriptor.h>
#include <folk/strategies/programs/spawn.h>

#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

namespace folk {

namespace {

std::error_code error_of(int number) { return {number, std::generic_category()}; }

/// posix_spawn's two tables, freed whatever happens.
class SpawnTables {
public:
  SpawnTables() {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawnattr_init(&attributes_);
  }
  ~SpawnTables() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  SpawnTables(const SpawnTables&) = delete;
  SpawnTables& operator=(const SpawnTables&) = delete;

  /// All three return an errno.
  int give(const FileDescriptor& file, int target) {
    return ::posix_spawn_file_actions_adddup2(&actions_, file.get(), target);
  }

  int set_signals_and_group(ProcessGroup group) {
    sigset_t signals;
    sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&attributes_, &signals);
    for (const int number : {SIGPIPE, SIGXFSZ}) sigaddset(&signals, number);
    ::posix_spawnattr_setsigdefault(&attributes_, &signals);
    ::posix_spawnattr_setpgroup(&attributes_, 0);
    const int own_group = group == ProcessGroup::own ? POSIX_SPAWN_SETPGROUP : 0;
    return ::posix_spawnattr_setflags(&attributes_,
                                      static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | own_group));
  }

  int start(pid_t& id, std::vector<std::string> argv) const {
    std::vector<char*> arguments;
    for (auto& argument : argv) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    return ::posix_spawnp(&id, arguments.front(), &actions_, &attributes_, arguments.data(), ::environ);
  }

private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

}  // namespace

std::error_code spawn(pid_t& id, const std::vector<std::string>& argv, const StandardStreams& streams,
                      ProcessGroup group) {
  SpawnTables tables;
  const std::array given{streams.input, streams.output, streams.error};
  // Copies above the targets: one dup2 cannot overwrite the source of the next, and none is of a descriptor onto
  // itself, which would leave it close-on-exec.
  std::array<FileDescriptor, 3> sources;
  for (int target = 0; target < 3; ++target) {
    const auto i = static_cast<std::size_t>(target);
    if (given[i] == StandardStreams::shared) continue;
    sources[i] = duplicate_above_standard(given[i]);
    if (sources[i].get() < 0) return error_of(errno);
    if (const int error = tables.give(sources[i], target); error != 0) return error_of(error);
  }
  if (const int error = tables.set_signals_and_group(group); error != 0) return error_of(error);
  return error_of(tables.start(id, argv));
}

}  // namespace folk
