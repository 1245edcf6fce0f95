#pragma once
// A program on the other end of a pipe as a player of the particle world: exec:"CMD". Its protocol is in
// docs/exec-protocol.md.

#include <folk/mpe/players/player.h>

#include <chrono>
#include <string>
#include <string_view>

namespace folk::mpe {

/// The controller exec:COMMAND; quotes around the command are taken off, and \" and \\ between them read as " and \.
/// Each of its players starts its own `/bin/sh -c COMMAND` and plays one episode after another. A player throws
/// EnvironmentError, naming the command, when the program cannot be started, ends early, is silent for `time_out`,
/// speaks unasked, or answers what is not two finite numbers. Throws UsageError when the command is blank or has
/// control characters, or the time-out is not between 1 ms and a day.
Controller exec_controller(std::string_view command, std::chrono::milliseconds time_out = std::chrono::seconds(5));

/// Reads "0.5 -1": an action. Throws UsageError on anything else.
struct Force {
  double x = 0;
  double y = 0;
};
Force parse_force(std::string_view line);

}  // namespace folk::mpe
