#include <folk/tools/ipd_evolve/evolution_output.h>

#include <folk/tools/program/csv.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/analysis/evolution/population_cooperation.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/text_file.h>

#include <cmath>
#include <iterator>
#include <numeric>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

double total_of(const Population& population) { return std::accumulate(population.begin(), population.end(), 0.0); }

/// "100 of each at the start", "300 at the start".
std::string start_text(const EvolveQuestion& question) {
  const Population& start = question.start;
  const bool even = std::equal(start.begin() + 1, start.end(), start.begin());
  if (question.dynamics->has_shares())
    return even ? "equal shares at the start" : "shares at the start as --start says";
  return even ? fmt::format("{} of each at the start", number_text(start.front()))
              : fmt::format("{} at the start", number_text(total_of(start)));
}

/// The row of a history that is the state itself is not there when rows are thinned.
std::vector<PopulationHistory::Row> rows_of(const EvolutionState& state) {
  auto rows = state.history.rows();
  if (rows.back().generation != state.generation) rows.push_back({state.generation, state.population});
  return rows;
}

void write_populations_csv(std::ostream& out, const EvolutionReport& report) {
  out << "generation";
  for (const auto& name : report.played.scores->names()) out << ',' << csv_field(name);
  out << '\n';
  fmt::memory_buffer line;
  for (const auto& [generation, population] : rows_of(report.evolution.state())) {
    line.clear();
    fmt::format_to(std::back_inserter(line), "{}", generation);
    for (const double number : population) fmt::format_to(std::back_inserter(line), ",{}", number_text(number));
    line.push_back('\n');
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

void write_cooperation_csv(std::ostream& out, const EvolutionReport& report) {
  out << "generation,percent_cooperation\n";
  for (const auto& [generation, population] : rows_of(report.evolution.state()))
    out << fmt::format("{},{}\n", generation, 100 * report.cooperation(population).value_or(0));
}

std::string extinct_text(const PopulationRank& entry) {
  return entry.extinct_at ? fmt::format("{}", *entry.extinct_at) : "";
}

}  // namespace

std::optional<double> EvolutionReport::cooperation(const Population& population) const {
  return population_cooperation(*played.scores, population, question.dynamics->has_shares() || question.meets_itself);
}

std::uint64_t EvolutionReport::signature() const {
  const auto& state = evolution.state();
  Signature signature;
  signature.add(played.scores->signature());
  signature.add(evolution.identity());
  signature.add(state.generation);
  signature.add(static_cast<std::uint64_t>(state.end));
  signature.add(state.period);
  for (const double number : state.population) signature.add(number);
  for (const std::uint64_t generation : state.extinct_at) signature.add(generation);
  return signature.value();
}

std::vector<std::size_t> survivors(const Evolution& evolution) {
  std::vector<std::size_t> found;
  for (const auto& entry : evolution.ranking())
    if (entry.population > evolution.dynamics().tolerance()) found.push_back(entry.entrant);
  return found;
}

std::string how_it_ended(const Evolution& evolution) {
  const auto& state = evolution.state();
  const auto generations = fmt::format("after {} generation{}", state.generation, state.generation == 1 ? "" : "s");
  switch (state.end) {
    case EvolutionEnd::fixed_point: return generations + " a fixed point";
    case EvolutionEnd::cycle: return fmt::format("{} a cycle of {} generations", generations, state.period);
    case EvolutionEnd::uniform: return generations + " one strategy has taken over";
    case EvolutionEnd::none: break;
  }
  return generations +
         (evolution.dynamics().is_random() ? ", chance goes on" : " not at a fixed point: more --generations go on");
}

void write_evolution_text(std::ostream& out, const EvolutionReport& report) {
  const auto& [played, question, evolution, command] = report;
  const auto& state = evolution.state();
  const std::size_t n = played.scores->size();
  out << visible_line(fmt::format("{} strategies evolve: {}", n, played.roster));
  out << visible_line(played.line + fmt::format(", seed {}", evolution.seed()));
  out << visible_line(fmt::format("{}; {}", question.dynamics->text(), start_text(question)));
  const double all = total_of(state.population);
  out << fmt::format("{}: {} of {} strategies are left", how_it_ended(evolution), survivors(evolution).size(), n);
  if (!question.dynamics->has_shares())
    out << fmt::format(", {} of {} individuals", number_text(all), number_text(total_of(question.start)));
  if (const auto cooperation = report.cooperation(state.population))
    out << fmt::format(", cooperation {:.2f} %", 100 * *cooperation);
  out << "\n\n";
  const bool random = question.dynamics->is_random();
  std::vector<std::string> header{"rank", "strategy", "population", "share %"};
  if (random) header.emplace_back("last quarter");
  header.emplace_back("extinct at");
  Table table(header);
  const auto mean = random ? state.history.mean_of_last_quarter() : Population(n, 0);
  for (const auto& entry : evolution.ranking()) {
    std::vector<std::string> row{
        fmt::format("{}", entry.rank), played.scores->names()[entry.entrant],
        question.dynamics->has_shares() ? fmt::format("{:.6f}", entry.population) : number_text(entry.population),
        fmt::format("{:.2f}", 100 * entry.population / all)};
    if (random) row.push_back(fmt::format("{:.2f}", mean[entry.entrant]));
    row.push_back(extinct_text(entry));
    table.add(std::move(row));
  }
  out << table.text();
  if (random) out << "\nlast quarter: the mean number over the last quarter of the generations\n";
  if (state.history.stride() > 1)
    out << fmt::format("{}of the generations from {} on every {}th is kept\n", random ? "" : "\n",
                       PopulationHistory::always_kept(n), state.history.stride());
  for (const auto& caveat : played.caveats) out << visible_line("note: " + caveat);
  out << fmt::format("{}signature {:016x}\n",
                     random || state.history.stride() > 1 || !played.caveats.empty() ? "" : "\n", report.signature());
}

void write_evolution_csv(std::ostream& out, const EvolutionReport& report) {
  out << "rank,name,population,extinct_at_generation\n";
  for (const auto& entry : report.evolution.ranking())
    out << fmt::format("{},{},{},{}\n", entry.rank, csv_field(report.played.scores->names()[entry.entrant]),
                       number_text(entry.population), extinct_text(entry));
}

void write_evolution_json(std::ostream& out, const EvolutionReport& report, bool as_file) {
  const auto& [played, question, evolution, command] = report;
  const auto& state = evolution.state();
  out << "{\n";
  if (as_file)
    out << fmt::format("  \"folk_version\": \"{}\",\n  \"command\": {},\n", FOLK_VERSION, json_string(command));
  for (const auto& [name, value] : played.members) out << fmt::format("  \"{}\": {},\n", name, value);
  out << fmt::format("  \"seed\": {},\n  \"model\": {},\n  \"parameters\": {},\n", evolution.seed(),
                     json_string(question.model), json_string(question.dynamics->text()));
  out << "  \"start\": {";
  for (std::size_t i = 0; i < question.start.size(); ++i)
    out << fmt::format("{}{}: {}", i == 0 ? "" : ", ", json_string(played.scores->names()[i]),
                       number_text(question.start[i]));
  out << fmt::format("}},\n  \"generations\": {},\n  \"fixed_point\": {},\n  \"cycle\": {},\n  \"one_left\": {},\n",
                     state.generation, state.end == EvolutionEnd::fixed_point,
                     state.end == EvolutionEnd::cycle ? fmt::format("{}", state.period) : "null",
                     living(state.population) == 1);
  const auto cooperation = report.cooperation(state.population);
  out << fmt::format("  \"individuals\": {},\n  \"cooperation\": {},\n  \"survivors\": [",
                     number_text(total_of(state.population)), cooperation ? fmt::format("{}", *cooperation) : "null");
  const char* separator = "";
  for (const std::size_t i : survivors(evolution)) {
    out << separator << json_string(played.scores->names()[i]);
    separator = ", ";
  }
  out << "],\n  \"notes\": [";
  for (std::size_t i = 0; i < played.caveats.size(); ++i) out << (i > 0 ? ", " : "") << json_string(played.caveats[i]);
  out << fmt::format("],\n  \"signature\": \"{:016x}\",\n  \"ranking\": [", report.signature());
  const auto mean = state.history.mean_of_last_quarter();
  separator = "\n";
  for (const auto& entry : evolution.ranking()) {
    out << fmt::format("{}    {{\"rank\": {}, \"name\": {}, \"population\": {}, \"extinct_at_generation\": {}",
                       separator, entry.rank, json_string(played.scores->names()[entry.entrant]),
                       number_text(entry.population), entry.extinct_at ? fmt::format("{}", *entry.extinct_at) : "null");
    if (question.dynamics->is_random()) out << fmt::format(", \"mean_of_last_quarter\": {}", mean[entry.entrant]);
    out << '}';
    separator = ",\n";
  }
  out << "\n  ]\n}\n";
}

void write_evolution_files(const fs::path& folder, const EvolutionReport& report) {
  write_file(folder / "ranking.csv", [&](std::ostream& out) { write_evolution_csv(out, report); });
  write_file(folder / "populations.csv", [&](std::ostream& out) { write_populations_csv(out, report); });
  if (report.played.scores->has_cooperation())
    write_file(folder / "cooperation.csv", [&](std::ostream& out) { write_cooperation_csv(out, report); });
  write_file(folder / "summary.json", [&](std::ostream& out) { write_evolution_json(out, report, true); });
}

}  // namespace folk::tools
