#include <folk/games/file_descriptor.h>
#include <folk/strategies/programs/keeper.h>
#include <folk/strategies/programs/pipes.h>
#include <folk/strategies/programs/spawn.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace folk {
namespace {

/// Reads "+ ID" and "- ID"; at the end of its input it kills what is on the list. It belongs to nobody, so that nobody
/// has to wait for it, and holds no stream of ours open.
constexpr const char* keep_list = R"(trap '' HUP INT TERM QUIT
exec 3<&0
{
  all=' '
  while read -r what id; do
    case $what in
      +) all="$all$id " ;;
      -) all="${all%% $id *} ${all#* $id }" ;;
    esac
  done
  for id in $all; do
    kill -s KILL -- "-$id" "$id"
  done
} <&3 3<&- &)";

class Keeper {
public:
  Keeper() {
    try {
      Pipe pipe = open_pipe();
      const FileDescriptor nowhere(::open("/dev/null", O_RDWR | O_CLOEXEC));
      pid_t shell = -1;
      if (nowhere.get() < 0 || spawn(shell, {"/bin/sh", "-c", keep_list},
                                     {pipe.read_end.get(), nowhere.get(), nowhere.get()}, ProcessGroup::own))
        return;
      while (::waitpid(shell, nullptr, 0) < 0 && errno == EINTR) {
      }
      list_ = std::move(pipe.write_end);
    } catch (const std::system_error&) {
    }
  }

  void tell(char what, pid_t leader) {
    if (list_.get() >= 0) write_without_signal(list_, fmt::format("{} {}\n", what, leader));
  }

private:
  FileDescriptor list_;
};

Keeper& keeper() {
  static Keeper only;
  return only;
}

}  // namespace

Kept::Kept(pid_t leader)
    : leader_(leader) {
  keeper().tell('+', leader_);
}

Kept::~Kept() { keeper().tell('-', leader_); }

}  // namespace folk
