#pragma once
// Who ends the programs that we started when we are gone without a word.

#include <sys/types.h>

namespace folk {

/// While it lives, a process and its group are killed when ours ends in whatever way, SIGKILL too. (PR_SET_PDEATHSIG
/// would not do: it asks for the thread that started the process, and spares the rest of the group.) One small shell
/// keeps the list for all; where it cannot be started there is no such help.
class Kept {
public:
  explicit Kept(pid_t leader);
  ~Kept();
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

private:
  pid_t leader_;
};

}  // namespace folk
