#pragma once
// The text form of finite machines: what a user writes in a @file, what Folk writes, and the data of the built-in ones.
//
//   # comment to the end of the line
//   machine my_tft
//   c  C  c d             state, move (C, D or P(C)), successor on their C, successor on their D
//   d  D  c d
//   machine grim
//   ok   C  ok bad bad bad    four successors: by (own, their) = CC CD DC DD
//   bad  D  bad bad
//
// The first state listed is the start unless a line "start STATE" says otherwise. ';' stands for a line end. The whole
// grammar is in docs/machine-files.md.

#include <folk/strategies/automaton.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// A machine of a file, with the name that its block gives it.
struct NamedMachine {
  std::string name;
  Automaton machine;
};

/// More states than this in one machine are refused.
inline constexpr std::size_t most_written_states = 1'000'000;

/// All machines of a text, in order; there is at least one, and each knows what its states are called. `source` (a
/// path) is what messages call the text. Throws InputFileError "source:LINE: what; mend" on the first fault.
std::vector<NamedMachine> read_machines(std::string_view text, const std::string& source);

/// One machine without a name, on one line: "c C c d; d D c d". Throws UsageError.
Automaton read_machine_line(std::string_view line);

/// The block of a machine, which read_machines reads back to an equal automaton. States are named after their moves:
/// c, c2, ... cooperate, d, d2, ... defect, m, m2, ... mix. What a name of the form cannot hold, as in "gtft(0.3)",
/// becomes '_' ("gtft_0.3").
/// Throws UsageError for an unrolled machine (Automaton::beyond), which has no meaning as play.
std::string write_machine(const std::string& name, const Automaton& machine);

}  // namespace folk
