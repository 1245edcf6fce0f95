#include <folk/games/error.h>
#include <folk/strategies/programs/idle_programs.h>

#include <utility>

namespace folk {
namespace {

void tell_end(ChildProcess& program) {
  try {
    program.send("end\n", ChildProcess::grace);
  } catch (const EnvironmentError&) {
    program.abandon();  // nothing more is asked, and the program is gone
  }
}

bool has_ended(ChildProcess& program) {
  try {
    program.has_spoken();
    return false;
  } catch (const EnvironmentError&) {
    program.abandon();
    return true;
  }
}

}  // namespace

IdlePrograms::~IdlePrograms() {
  for (const auto& program : idle_) tell_end(*program);  // all of them before the first is waited for
}

void IdlePrograms::give(std::unique_ptr<ChildProcess> program) {
  {
    const std::lock_guard lock(mutex_);
    if (idle_.size() < most) {
      idle_.push_back(std::move(program));
      return;
    }
  }
  tell_end(*program);
}

std::unique_ptr<ChildProcess> IdlePrograms::take() {
  for (;;) {
    std::unique_ptr<ChildProcess> program;
    {
      const std::lock_guard lock(mutex_);
      if (idle_.empty()) return nullptr;
      program = std::move(idle_.back());
      idle_.pop_back();
    }
    if (!has_ended(*program)) return program;
  }
}

}  // namespace folk
