#pragma once
// Ranks over sub-rosters of a finished tournament: the option that asks for them, and text, CSV and JSON.

#include <folk/tools/program/program.h>

#include <folk/analysis/tournament/sub_rosters.h>
#include <folk/analysis/tournament/tournament.h>

#include <optional>
#include <ostream>
#include <string>

namespace folk::tools {

/// N[:SAMPLES] of --sub-rosters, if it is given, for a tournament of so many strategies.
std::optional<SubRosterSettings> chosen_sub_rosters(const po::variables_map& values, std::size_t strategies);

/// A table, the best mean rank first, under a line that says which sub-rosters they are.
void write_sub_rosters_text(std::ostream& out, const Tournament& tournament, const SubRosters& sub_rosters);

/// Columns that a ranking in CSV gets: their names, and one entrant's values.
extern const char* const sub_roster_csv_columns;
std::string sub_roster_csv_fields(const SubRosterRanks& ranks);

/// The same columns beside the names, the best mean rank first.
void write_sub_rosters_csv(std::ostream& out, const Tournament& tournament, const SubRosters& sub_rosters);

/// The member "sub_rosters" of a tournament's JSON object, a comma before it.
void write_sub_rosters_json(std::ostream& out, const Tournament& tournament, const SubRosters& sub_rosters);

}  // namespace folk::tools
