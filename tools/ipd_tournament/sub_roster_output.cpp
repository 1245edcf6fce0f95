#include <folk/tools/ipd_tournament/sub_roster_output.h>

#include <folk/tools/program/csv.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/games/error.h>

namespace folk::tools {
namespace {

constexpr std::uint64_t most_samples = 1'000'000'000;

/// Nothing is known of the ranks of a strategy that no sub-roster drawn has.
std::string known(const SubRosterRanks& entry, const std::string& text, const char* unknown) {
  return entry.sub_rosters == 0 ? unknown : text;
}

}  // namespace

std::optional<SubRosterSettings> chosen_sub_rosters(const po::variables_map& values, std::size_t strategies) {
  if (values.count("sub-rosters") == 0) return std::nullopt;
  const std::string text = text_option(values, "sub-rosters");
  const auto colon = text.find(':');
  SubRosterSettings settings;
  if (strategies < 2) throw UsageError("--sub-rosters needs a roster of at least 2 strategies");
  settings.size = parse_whole_number(text.substr(0, colon), "--sub-rosters", 2, strategies);
  if (colon != std::string::npos)
    settings.samples = parse_whole_number(text.substr(colon + 1), "samples of --sub-rosters", 1, most_samples);
  return settings;
}

void write_sub_rosters_text(std::ostream& out, const Tournament& tournament, const SubRosters& sub_rosters) {
  out << fmt::format(
      "\nRanks in {} sub-rosters of {} of the {} strategies{}\n\n",
      sub_rosters.all ? fmt::format("all {}", sub_rosters.looked_at) : fmt::format("{}", sub_rosters.looked_at),
      sub_rosters.size, tournament.size(),
      sub_rosters.all ? "" : fmt::format(", drawn with seed {}", tournament.settings().seed));
  Table table({"strategy", "mean rank", "deviation", "best", "25 %", "median", "75 %", "worst", "won %", "in"});
  for (const std::size_t i : sub_rosters.best_first) {
    const SubRosterRanks& entry = sub_rosters.ranks[i];
    std::vector<std::string> row{tournament.name(i)};
    for (const std::string& cell : {fmt::format("{:.4f}", entry.mean), fmt::format("{:.4f}", entry.deviation),
                                    fmt::format("{}", entry.best), fmt::format("{}", entry.lower_quartile),
                                    fmt::format("{}", entry.median), fmt::format("{}", entry.upper_quartile),
                                    fmt::format("{}", entry.worst), fmt::format("{:.2f}", 100 * entry.won)})
      row.push_back(known(entry, cell, ""));
    row.push_back(fmt::format("{}", entry.sub_rosters));
    table.add(std::move(row));
  }
  out << table.text();
  out << "\nrank: one more than those that earned more in the tournament of the sub-roster alone; 25 %: the rank that "
         "a\n"
         "quarter of its ranks do not exceed; won: nobody earned more; in: sub-rosters that have it\n";
}

const char* const sub_roster_csv_columns =
    "sub_rosters,mean_rank,rank_deviation,best_rank,lower_quartile_rank,median_rank,upper_quartile_rank,worst_rank,won";

std::string sub_roster_csv_fields(const SubRosterRanks& ranks) {
  return fmt::format(
      "{},{}", ranks.sub_rosters,
      known(ranks,
            fmt::format("{},{},{},{},{},{},{},{}", ranks.mean, ranks.deviation, ranks.best, ranks.lower_quartile,
                        ranks.median, ranks.upper_quartile, ranks.worst, ranks.won),
            ",,,,,,,"));
}

void write_sub_rosters_csv(std::ostream& out, const Tournament& tournament, const SubRosters& sub_rosters) {
  out << "strategy," << sub_roster_csv_columns << '\n';
  for (const std::size_t i : sub_rosters.best_first)
    out << csv_field(tournament.name(i)) << ',' << sub_roster_csv_fields(sub_rosters.ranks[i]) << '\n';
}

void write_sub_rosters_json(std::ostream& out, const Tournament& tournament, const SubRosters& sub_rosters) {
  out << fmt::format(
      ",\n  \"sub_rosters\": {{\"size\": {}, \"possible\": \"{}\", \"looked_at\": {}, \"all\": {}, "
      "\"ranking\": [",
      sub_rosters.size, sub_rosters.possible.str(), sub_rosters.looked_at, sub_rosters.all);
  const char* separator = "\n";
  for (const std::size_t i : sub_rosters.best_first) {
    const SubRosterRanks& entry = sub_rosters.ranks[i];
    const auto number = [&](auto value) { return known(entry, fmt::format("{}", value), "null"); };
    out << fmt::format(
        "{}    {{\"name\": {}, \"sub_rosters\": {}, \"mean_rank\": {}, \"rank_deviation\": {}, \"best_rank\": {}, "
        "\"lower_quartile_rank\": {}, \"median_rank\": {}, \"upper_quartile_rank\": {}, \"worst_rank\": {}, "
        "\"won\": {}}}",
        separator, json_string(tournament.name(i)), entry.sub_rosters, number(entry.mean), number(entry.deviation),
        number(entry.best), number(entry.lower_quartile), number(entry.median), number(entry.upper_quartile),
        number(entry.worst), number(entry.won));
    separator = ",\n";
  }
  out << "\n  ]}";
}

}  // namespace folk::tools
