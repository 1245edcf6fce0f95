#pragma once
// A program on the other end of a pipe as a player: exec:"CMD". Its protocol is in docs/exec-protocol.md.

#include <folk/games/move.h>
#include <folk/strategies/programs/program_rules.h>
#include <folk/strategies/strategy.h>

#include <optional>
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

/// The strategy of a program. Each of its players starts its own `/bin/sh -c COMMAND` at its first match, or goes on
/// with one that took long to start and that another player of the same strategy has finished with. A player throws
/// EnvironmentError, naming the command, when the program cannot be started, ends early, is silent for too long,
/// answers what is no move or speaks unasked (found before the next question, or by Player::finish); start() then
/// begins anew with a fresh program. Throws UsageError as check_call does.
Strategy exec_strategy(ProgramCall call);

}  // namespace folk
