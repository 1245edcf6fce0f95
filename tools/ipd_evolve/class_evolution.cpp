#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/ipd_evolve/class_evolution.h>
#include <folk/tools/ipd_evolve/evolution_output.h>
#include <folk/tools/ipd_evolve/pictures.h>
#include <folk/tools/ipd_evolve/run_journal.h>
#include <folk/tools/ipd_evolve/scores.h>
#include <folk/tools/program/launch.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/program/output_folder.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/table.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/analysis/evolution/class_selection.h>
#include <folk/analysis/evolution/evolution.h>
#include <folk/analysis/evolution/leading_behaviours.h>
#include <folk/analysis/pictures/population_plot.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

namespace folk::tools {
namespace {

/// Text shows so many members and JSON's ranking has all that are alive.
constexpr std::size_t most_shown = 50;

/// All that an output needs.
struct ClassEvolution {
  MemoryClass members;
  ChosenGame game;
  Criterion criterion;
  const Evolution& evolution;
  const ClassSelection& selection;
  std::uint64_t each = 100;  // at the start
  std::uint64_t identity = 0;
  std::string command;

  std::string name(std::size_t member) const { return members.member(member).name(); }
  std::size_t size() const { return evolution.state().population.size(); }
  double individuals() const {
    const auto& population = evolution.state().population;
    return std::accumulate(population.begin(), population.end(), 0.0);
  }
  std::uint64_t signature() const {
    const auto& state = evolution.state();
    Signature signature;
    signature.add(identity);
    signature.add(state.generation);
    signature.add(static_cast<std::uint64_t>(state.end));
    for (const double number : state.population) signature.add(number);
    for (const std::uint64_t generation : state.extinct_at) signature.add(generation);
    return signature.value();
  }
};

/// The summaries that were kept and the generation that was reached.
std::vector<GenerationSummary> summaries_of(const Evolution& evolution) {
  auto summaries = evolution.state().summaries;
  const auto last = summary_of(evolution.state().generation, evolution.state().population);
  if (summaries.back().generation != last.generation) summaries.push_back(last);
  return summaries;
}

void write_text(std::ostream& out, const ClassEvolution& report) {
  const auto& state = report.evolution.state();
  out << fmt::format("All {} members of {} evolve\n", report.size(), report.members.name());
  out << visible_line(fmt::format("game {}, {}, noise 0", game_words(report.game.title, report.game.payoffs),
                                  report.criterion.to_string()));
  out << fmt::format("ecological competition; {} of each at the start\n", report.each);
  out << fmt::format("{}: {} of {} members are left, {} of {} individuals, cooperation {:.2f} %\n\n",
                     how_it_ended(report.evolution), living(state.population), report.size(),
                     number_text(report.individuals()), report.each * report.size(),
                     100 * report.selection.cooperation(state.population));
  Table generations({"generation", "members", "individuals", "most numerous", "number"});
  const auto summaries = summaries_of(report.evolution);
  for (const auto& [generation, alive, individuals, leader, number] : summaries)
    if (generation <= 10 || generation % 10 == 0 || generation == state.generation)
      generations.add({fmt::format("{}", generation), fmt::format("{}", alive), number_text(individuals),
                       report.name(leader), number_text(number)});
  out << generations.text() << '\n';
  Table ranking({"rank", "member", "population", "share %"});
  std::size_t shown = 0;
  for (const auto& entry : report.evolution.ranking()) {
    if (shown == most_shown || !(entry.population > 0)) break;
    ++shown;
    ranking.add({fmt::format("{}", entry.rank), report.name(entry.entrant), number_text(entry.population),
                 fmt::format("{:.2f}", 100 * entry.population / report.individuals())});
  }
  out << ranking.text();
  if (const auto alive = living(state.population); shown < alive)
    out << fmt::format("... the first {} of {}: --format csv and --output have all, the dead too\n", shown, alive);
  out << fmt::format("\nsignature {:016x}\n", report.signature());
}

void write_csv(std::ostream& out, const ClassEvolution& report) {
  out << "rank,name,population,extinct_at_generation\n";
  fmt::memory_buffer rows;
  for (const auto& entry : report.evolution.ranking())
    fmt::format_to(std::back_inserter(rows), "{},{},{},{}\n", entry.rank, report.name(entry.entrant),
                   number_text(entry.population), entry.extinct_at ? fmt::format("{}", *entry.extinct_at) : "");
  out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
}

void write_generations_csv(std::ostream& out, const ClassEvolution& report) {
  out << "generation,members,individuals,most_numerous,number\n";
  for (const auto& [generation, alive, individuals, leader, number] : summaries_of(report.evolution))
    out << fmt::format("{},{},{},{},{}\n", generation, alive, number_text(individuals), report.name(leader),
                       number_text(number));
}

void write_json(std::ostream& out, const ClassEvolution& report, bool as_file) {
  const auto& state = report.evolution.state();
  out << "{\n";
  if (as_file)
    out << fmt::format("  \"folk_version\": \"{}\",\n  \"command\": {},\n", FOLK_VERSION, json_string(report.command));
  out << fmt::format("  \"class\": \"{}\",\n  \"class_size\": \"{}\",\n  \"game\": {},\n", report.members.name(),
                     report.members.size().str(), json_string(report.game.title));
  out << fmt::format("  \"payoffs\": {},\n  \"criterion\": \"{}\",\n", payoffs_json(report.game.payoffs),
                     report.criterion.to_string());
  out << fmt::format("  \"model\": \"ecological\",\n  \"population\": {},\n  \"generations\": {},\n", report.each,
                     state.generation);
  out << fmt::format("  \"fixed_point\": {},\n  \"cycle\": {},\n", state.end == EvolutionEnd::fixed_point,
                     state.end == EvolutionEnd::cycle ? fmt::format("{}", state.period) : "null");
  out << fmt::format(
      "  \"individuals\": {},\n  \"cooperation\": {},\n  \"survivors\": {},\n  \"signature\": "
      "\"{:016x}\",\n  \"trajectory\": [",
      number_text(report.individuals()), report.selection.cooperation(state.population), living(state.population),
      report.signature());
  const char* separator = "\n";
  for (const auto& [generation, alive, individuals, leader, number] : summaries_of(report.evolution)) {
    out << fmt::format(
        "{}    {{\"generation\": {}, \"members\": {}, \"individuals\": {}, \"most_numerous\": \"{}\", "
        "\"number\": {}}}",
        separator, generation, alive, number_text(individuals), report.name(leader), number_text(number));
    separator = ",\n";
  }
  out << "\n  ],\n  \"ranking\": [";
  separator = "\n";
  fmt::memory_buffer rows;
  for (const auto& entry : report.evolution.ranking()) {
    if (!(entry.population > 0)) break;
    fmt::format_to(std::back_inserter(rows), "{}    {{\"rank\": {}, \"name\": \"{}\", \"population\": {}}}", separator,
                   entry.rank, report.name(entry.entrant), number_text(entry.population));
    separator = ",\n";
  }
  out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
  out << "\n  ]\n}\n";
}

/// populations and stack: the behaviours that are most numerous in the end, and all others as one.
void draw_class(const std::filesystem::path& folder, const ClassEvolution& report,
                const std::shared_ptr<const ClassSelection>& selection, const Population& start,
                const std::string& extension, const Common& common) {
  ProgressBar bar("evolving again, for the pictures", !common.quiet);
  const LeadingBehaviours leading =
      leading_behaviours(selection, start, report.evolution.state(), most_coloured - 1, std::ref(bar));
  PopulationPlot plot;
  for (const std::uint32_t member : leading.members) plot.names.push_back(report.name(member));
  plot.names.push_back(fmt::format("{} other behaviours", leading.others));
  plot.ranking.resize(plot.names.size());
  std::iota(plot.ranking.begin(), plot.ranking.end(), std::size_t{0});
  plot.rows = leading.rows;
  plot.title = fmt::format("{}: {}, by behaviour", report.members.name(), selection->text());
  plot.caption = {game_words(report.game.title, report.game.payoffs), report.criterion.to_string()};
  draw_lines(plot, folder / ("populations." + extension));
  draw_stack(plot, folder / ("stack." + extension));
}

void refuse_what_needs_a_roster(const po::variables_map& values, const MemoryClass& members) {
  for (const char* name : {"include", "exclude", "repetitions", "tournament", "start", "individuals", "runs",
                           "fixation", "stationary", "exact", "sample", "extrapolate"})
    if (values.count(name) != 0)
      throw UsageError(fmt::format("--{} does not go with all of {}: it is for rosters of up to {} strategies", name,
                                   members.name(), MemoryClass::most_listed));
  if (const auto model = text_option(values, "model", "ecological"); model != "ecological")
    throw UsageError(fmt::format("--model {} does not go with all of {}: only ecological does", model, members.name()));
  if (parse_number(text_option(values, "noise"), "--noise", 0, 1) > 0)
    throw UsageError(
        fmt::format("--noise does not go with all of {}: its members are told apart by exact play", members.name()));
}

}  // namespace

int evolve_class(const MemoryClass& members, const po::variables_map& values, const Common& common) {
  refuse_what_needs_a_roster(values, members);
  const ChosenGame game = chosen_game(values);
  const Criterion criterion = chosen_criterion(values);
  const auto each = whole_option(values, "population", 100, 1, static_cast<std::uint64_t>(most_individuals));
  const auto generations = whole_option(values, "generations", 1000, 0, 1'000'000'000'000'000);
  const unsigned threads = threads_option(values, common);
  const auto picture = chosen_picture(values);
  const auto folder = output_folder(values);
  Journal journal = journal_option(values);
  note_unusual_payoffs(game, common);
  if (!(members.size() <= Integer(std::uint64_t{1} << 31)))
    throw UsageError(fmt::format("{} has {} members: populations take classes up to X + Y = 4", members.name(),
                                 members.size_text()));
  const Population start(std::size_t{1} << members.genes(), static_cast<double>(each));
  const auto selection =
      std::make_shared<ClassSelection>(members, game.payoffs, criterion, start, threads, nullptr, crew());
  Evolution evolution(selection, start);
  Signature what;
  what.add(members.name());
  what.add(to_text(game.payoffs));
  what.add(criterion.to_string());
  what.add(evolution.identity());
  const std::uint64_t identity = what.value();
  run_with_journal(evolution, generations, journal, identity, start.size(), common);
  if (!crew().first()) return done;
  const ClassEvolution report{members, game, criterion, evolution, *selection, each, identity, common.command};
  if (folder) {
    write_file(*folder / "ranking.csv", [&](std::ostream& out) { write_csv(out, report); });
    write_file(*folder / "generations.csv", [&](std::ostream& out) { write_generations_csv(out, report); });
    write_file(*folder / "summary.json", [&](std::ostream& out) { write_json(out, report, true); });
    if (picture) draw_class(*folder, report, selection, start, *picture, common);
  }
  switch (common.format) {
    case Format::text: write_text(std::cout, report); break;
    case Format::csv: write_csv(std::cout, report); break;
    case Format::json: write_json(std::cout, report, false); break;
  }
  return done;
}

}  // namespace folk::tools
