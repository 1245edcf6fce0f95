#pragma once
// A program on the other end of a pipe as a player: exec:"CMD". Its protocol is in docs/exec-protocol.md.

#include <folk/games/move.h>
#include <folk/strategies/strategy.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace folk {

/// What a program answers to the line "move".
struct Reply {
  Move move = Move::C;
  std::optional<double> belief;  ///< P(the opponent plays C in this round)

  bool operator==(const Reply&) const = default;
};

/// Reads "C", "D" or a move with a belief: "C 0.85". Blanks at the end and a Windows line end do no harm.
/// Throws UsageError on anything else.
Reply parse_reply(std::string_view line);

/// The strategy exec:"COMMAND". Each of its players starts its own `/bin/sh -c COMMAND` at its first match.
/// A player throws EnvironmentError, naming the command, when the program cannot be started, ends early, is silent for
/// `time_out`, or answers what is no move; start() then begins anew with a fresh program.
/// Throws UsageError when the command is blank or has control characters, or time_out is not from 1 ms to a day.
Strategy exec_strategy(const std::string& command, std::chrono::milliseconds time_out = std::chrono::seconds(5));

}  // namespace folk
