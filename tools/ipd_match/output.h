#pragma once
// A finished match as text, CSV and JSON.

#include <cstddef>
#include <ostream>

#include <folk/tools/ipd_match/record.h>

namespace folk::tools {

/// What text is written on.
struct Sheet {
  std::size_t width = 80;  ///< columns
  bool colours = false;
};

/// The sheet that stdout is: a terminal's own width, and colours there unless NO_COLOR or TERM=dumb forbids them.
Sheet sheet_of_stdout();

/// The moves as people write them, in lines of whole tens of rounds, with running scores, beliefs and totals.
void write_text(std::ostream& out, const MatchSettings& settings, const MatchRecord& record, const Sheet& sheet);

/// A line a round: round,move1,move2,score1,score2,belief1,belief2.
void write_csv(std::ostream& out, const MatchSettings& settings, const MatchRecord& record);

/// One object; docs/ipd-match.md says what it holds.
void write_json(std::ostream& out, const MatchSettings& settings, const MatchRecord& record);

}  // namespace folk::tools
