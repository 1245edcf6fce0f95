#include <folk/tools/program/interruption.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <csignal>
#include <initializer_list>

namespace folk::tools {
namespace {

volatile std::sig_atomic_t flag = 0;

extern "C" void on_interruption(int) { flag = 1; }

}  // namespace

Interruption::Interruption() {
  struct sigaction action {};
  action.sa_handler = on_interruption;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // A shell starts background work with SIGINT ignored: that stays so.
    if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction(number, &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction now {};
    if (::sigaction(number, nullptr, &now) == 0 && now.sa_handler == on_interruption) std::signal(number, SIG_DFL);
  }
}

bool Interruption::requested() { return flag != 0; }

void end_interrupted(bool kept, const std::string& how_far) {
  throw EnvironmentError(
      fmt::format("interrupted after {}; {}", how_far,
                  kept ? "the same command goes on from there" : "nothing is kept without --journal FILE"));
}

}  // namespace folk::tools
