#pragma once
// Who can invade whom in a finished tournament, as text, CSV and JSON.

#include <folk/analysis/evolution/invasion.h>
#include <folk/analysis/tournament/tournament.h>

#include <ostream>
#include <string>

namespace folk::tools {

/// A table: residents in rank order, how stable each is, and who invades it strictly, by name.
void write_invasion_text(std::ostream& out, const Tournament& tournament, const Invasions& invasions);

/// Columns that a ranking in CSV gets: their names, and one entrant's values.
extern const char* const invasion_csv_columns;
std::string invasion_csv_fields(const Invasions& invasions, std::size_t entrant);

/// The matrix: a resident a row, a mutant a column, the resident's stability last.
void write_invasion_csv(std::ostream& out, const Tournament& tournament, const Invasions& invasions);

/// The member "invasion" of a tournament's JSON object, a comma before it; in roster order.
void write_invasion_json(std::ostream& out, const Invasions& invasions);

}  // namespace folk::tools
