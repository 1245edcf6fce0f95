#include <folk/tools/ipd_tournament/invasion_output.h>

#include <folk/tools/program/csv.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace folk::tools {
namespace {

/// Names on lines of at most `width` characters, where a single one is not longer.
std::vector<std::string> wrapped(const std::vector<std::string>& names, std::size_t width) {
  std::vector<std::string> lines(1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string word = names[i] + (i + 1 < names.size() ? "," : "");
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

/// Mutants that fare so, best ranked first.
std::vector<std::string> ranked_names(const Tournament& tournament, const Invasions& invasions, std::size_t resident,
                                      Invasion how) {
  std::vector<std::string> names;
  for (const auto& entry : tournament.ranking())
    if (entry.entrant != resident && invasions.invasion(entry.entrant, resident) == how)
      names.push_back(tournament.name(entry.entrant));
  return names;
}

/// Longer lists are cut off in the text.
constexpr std::size_t most_listed = 40;

std::size_t longest_name(const Tournament& tournament) {
  std::size_t longest = 8;
  for (std::size_t i = 0; i < tournament.size(); ++i) longest = std::max(longest, tournament.name(i).size());
  return longest;
}

char letter(Invasion invasion) {
  switch (invasion) {
    case Invasion::resists: return '-';
    case Invasion::weakly: return 'w';
    case Invasion::strictly: return 's';
    case Invasion::undecided: break;
  }
  return '?';
}

}  // namespace

void write_invasion_text(std::ostream& out, const Tournament& tournament, const Invasions& invasions) {
  constexpr std::size_t page = 120;
  const std::size_t taken = longest_name(tournament) + 44;
  const std::size_t width = page > taken + 30 ? page - taken : 30;
  Table table({"resident", "stability", "weakly", "undecided", "invaded strictly by"});
  for (const auto& entry : tournament.ranking()) {
    const std::size_t resident = entry.entrant;
    auto names = ranked_names(tournament, invasions, resident, Invasion::strictly);
    if (names.size() > most_listed) {
      const std::size_t more = names.size() - most_listed;
      names.resize(most_listed);
      names.push_back(fmt::format("{} more", more));
    }
    std::vector<std::string> row{tournament.name(resident), std::string(to_string(invasions.stability(resident))),
                                 fmt::format("{}", invasions.mutants(resident, Invasion::weakly).size()),
                                 fmt::format("{}", invasions.mutants(resident, Invasion::undecided).size()), ""};
    for (const std::string& line : wrapped(names, width)) {
      row.back() = line;
      table.add(row);
      std::fill(row.begin(), row.end(), "");
    }
  }
  out << "\nWho can invade residents that all play the same (Maynard Smith & Price 1973)\n\n" << table.text();
  out << "\nweakly: mutants that drift in, earning the same; undecided: scores that are not exact enough\n";
}

const char* const invasion_csv_columns = "stability,invaded_strictly,invaded_weakly,undecided";

std::string invasion_csv_fields(const Invasions& invasions, std::size_t entrant) {
  return fmt::format(
      "{},{},{},{}", to_string(invasions.stability(entrant)), invasions.mutants(entrant, Invasion::strictly).size(),
      invasions.mutants(entrant, Invasion::weakly).size(), invasions.mutants(entrant, Invasion::undecided).size());
}

void write_invasion_csv(std::ostream& out, const Tournament& tournament, const Invasions& invasions) {
  out << "resident\\mutant";
  for (std::size_t j = 0; j < tournament.size(); ++j) out << ',' << csv_field(tournament.name(j));
  out << ",stability\n";
  for (std::size_t i = 0; i < tournament.size(); ++i) {
    out << csv_field(tournament.name(i));
    for (std::size_t j = 0; j < tournament.size(); ++j)
      out << ',' << (i == j ? "" : to_string(invasions.invasion(j, i)));
    out << ',' << to_string(invasions.stability(i)) << '\n';
  }
}

void write_invasion_json(std::ostream& out, const Invasions& invasions) {
  out << fmt::format(
      ",\n  \"invasion\": {{\n    \"equal_within\": {},\n    \"decisive_errors\": {},\n    \"stability\": [",
      equal_within, decisive_errors);
  for (std::size_t i = 0; i < invasions.size(); ++i)
    out << (i == 0 ? "" : ", ") << '"' << to_string(invasions.stability(i)) << '"';
  out << "],\n    \"rows\": [";
  for (std::size_t i = 0; i < invasions.size(); ++i) {
    std::string row;
    for (std::size_t j = 0; j < invasions.size(); ++j) row += i == j ? '.' : letter(invasions.invasion(j, i));
    out << (i == 0 ? "\n      \"" : ",\n      \"") << row << '"';
  }
  out << "\n    ]\n  }";
}

}  // namespace folk::tools
