#pragma once
// A program on the other end of a pipe as a player of the particle world: exec:"CMD". Its protocol is in
// docs/exec-protocol.md.

#include <folk/mpe/players/player.h>
#include <folk/strategies/programs/program_rules.h>

#include <string_view>

namespace folk::mpe {

/// The controller of a program. Each of its players starts its own `/bin/sh -c COMMAND` and plays one episode after
/// another. A player throws EnvironmentError, naming the command, when the program cannot be started, ends early, is
/// silent for too long, speaks unasked (found before the next question, or by Player::finish), or answers what is not
/// two finite numbers. Throws UsageError as check_call does.
Controller exec_controller(const ProgramCall& call);

/// Reads "0.5 -1": an action. Throws UsageError on anything else.
struct Force {
  double x = 0;
  double y = 0;
};
Force parse_force(std::string_view line);

}  // namespace folk::mpe
