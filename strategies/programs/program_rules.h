#pragma once
// How a program is named and how long it is waited for: exec:"CMD" and exec("CMD";timeout=60;start=120;deterministic).

#include <chrono>
#include <string>
#include <string_view>

namespace folk {

inline double seconds(std::chrono::milliseconds time) { return std::chrono::duration<double>(time).count(); }

/// How a program on a pipe is treated.
struct ProgramRules {
  std::chrono::milliseconds first_answer = std::chrono::seconds(60);  ///< counted from its start, which takes time
  std::chrono::milliseconds answer = std::chrono::seconds(5);         ///< any later one
  bool deterministic = false;  ///< it always does the same after the same moves: its user says so

  bool operator==(const ProgramRules&) const = default;
};

/// A shell command that plays.
struct ProgramCall {
  std::string command;
  ProgramRules rules{};

  bool operator==(const ProgramCall&) const = default;
};

/// Reads what follows "exec": :"CMD", :CMD without quotes, or ("CMD";SETTING;...), settings `timeout=SECONDS` (of an
/// answer), `start=SECONDS` (of the first, at least the other) and `deterministic`, each once at most. \" and
/// \\ between the quotes read as " and \. Throws UsageError, also when the command is blank or has control characters,
/// or a time is not from 1 ms to a day.
ProgramCall parse_program_call(std::string_view text);

/// Throws UsageError as parse_program_call does.
void check_call(const ProgramCall& call);

/// The name that reads back to the same call: exec:"CMD" where all settings are the usual ones.
std::string to_string(const ProgramCall& call);

/// True for a name that parse_program_call is to read, its "exec" taken off.
bool names_a_program(std::string_view name);

}  // namespace folk
