// ipd-tournament: the round robin of a roster.

#include "game_option.h"
#include "play_options.h"
#include "program.h"
#include "progress.h"
#include "standard_names.h"
#include "tournament_output.h"

#include <fmt/format.h>
#include <folk/analysis/plots.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <optional>
#include <system_error>
#include <thread>

#include <unistd.h>

namespace folk::tools {
namespace {

Program program() {
  Program program;
  program.name = "ipd-tournament";
  program.usage = "[options]";
  program.summary =
      "Plays every strategy of a roster against every other and itself, exactly wherever that can be done,\n"
      "and prints the ranking. SPEC is a comma list of names, rosters (classics, sct2025, all), families\n"
      "(memory(1,2)), genotypes (mem12_ccCDCDDCDD), @FILE and exec:\"CMD\"; 'ipd-strategies list' shows all.";
  program.examples = {"ipd-tournament", "ipd-tournament --strategies pavlov,tit_for_tat,all_d --rounds 1000",
                      "ipd-tournament --include @examples/my_strategies.machines --noise 0.01 --output results --plot",
                      "ipd-tournament --strategies 'memory(1,2)' --rounds 1000 --format csv",
                      "ipd-tournament --criterion discounted:0.9 --payoffs T=4,R=3,P=1,S=0 --format json"};
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("strategies", text()->default_value("classics"), "the roster: SPEC");
  add("include", text(), "SPEC of entrants beside the roster; payoffs are normalised by the roster alone");
  add("exclude", text(), "SPEC of strategies to leave out");
  add("rounds", text(), "rounds of a match (default 100); the same as --criterion finite:N");
  add("criterion", text(), "finite:T (sum), discounted:d (normalised by 1-d), mean, ending:p (expected sum)");
  add("end-probability", text(), "each round is the last with this probability; the same as --criterion ending:p");
  add("noise", text()->default_value("0"), "each move flips with this probability, from 0 to 1");
  add_game_options(program.options);
  add_play_options(program.options);
  add("no-self-play", "nobody meets its own copy");
  add("repetitions", text(), "matches of a pair that can only be sampled (default 100)");
  add("seed", text(), "of all random numbers (default 1)");
  add("threads", text(), "threads (default: one a processor); the results do not depend on it");
  add("output", text(), "folder for ranking.csv, scores.csv, cooperation.csv, beliefs.csv, summary.json");
  add("plot", text()->implicit_value("svg"), "svg or png: also draw payoffs, cooperation and scores into --output");
  return program;
}

Criterion criterion_of(const po::variables_map& values) {
  std::optional<Criterion> chosen;
  const auto choose = [&](const char* option, const Criterion& criterion) {
    if (chosen && !(*chosen == criterion))
      throw UsageError(fmt::format("--{} says {}, another option says {}: give one of them", option,
                                   criterion.to_string(), chosen->to_string()));
    chosen = criterion;
  };
  if (values.count("rounds") != 0) choose("rounds", Criterion::finite(parse_rounds(text_option(values, "rounds"))));
  if (values.count("criterion") != 0) choose("criterion", Criterion::parse(text_option(values, "criterion")));
  if (values.count("end-probability") != 0)
    choose("end-probability",
           Criterion::ending(parse_number(text_option(values, "end-probability"), "--end-probability", 0, 1)));
  return chosen.value_or(Criterion::finite(100));
}

/// The roster less what is excluded; the included entrants follow it.
struct Field {
  std::vector<Strategy> entrants;
  std::size_t core = 0;
};

Field field_of(const po::variables_map& values, const Payoffs& payoffs) {
  const Registry registry = standard_names(chosen_play_options(values));
  Field field{registry.roster(text_option(values, "strategies"), payoffs), 0};
  if (values.count("exclude") != 0)
    for (const auto& left_out : registry.roster(text_option(values, "exclude"), payoffs)) {
      const auto same = [&](const Strategy& strategy) { return same_name(strategy.name, left_out.name); };
      if (std::erase_if(field.entrants, same) == 0)
        throw UsageError(fmt::format("--exclude {}: it is not in the roster", left_out.name));
    }
  if (field.entrants.empty()) throw UsageError("the roster is empty: --exclude leaves nobody");
  field.core = field.entrants.size();
  if (values.count("include") != 0)
    for (auto& guest : registry.roster(text_option(values, "include"), payoffs))
      field.entrants.push_back(std::move(guest));
  refuse_duplicates(field.entrants);
  return field;
}

/// Made before anything is played: what cannot be written should not be waited for.
std::optional<std::filesystem::path> output_folder(const po::variables_map& values) {
  if (values.count("output") == 0) return std::nullopt;
  std::filesystem::path folder = text_option(values, "output");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw EnvironmentError(fmt::format("--output '{}': no folder of that name can be made: {}", folder.string(),
                                       error ? error.message() : "a file has it"));
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw EnvironmentError(fmt::format("--output '{}': cannot be written: {}", folder.string(), std::strerror(errno)));
  return folder;
}

/// svg, png or nothing, once it is clear that so many strategies can be drawn here.
std::optional<std::string> picture_extension(const po::variables_map& values, std::size_t strategies) {
  if (values.count("plot") == 0) return std::nullopt;
  const auto extension = text_option(values, "plot");
  if (extension != "svg" && extension != "png")
    throw UsageError(fmt::format("--plot '{}': expected svg or png", extension));
  if (values.count("output") == 0) throw UsageError("--plot needs a folder for its pictures: give --output DIR");
  require_plotter(strategies);
  return extension;
}

int tournament(const po::variables_map& values, const Common& common) {
  const ChosenGame game = chosen_game(values);
  TournamentSettings settings;
  settings.payoffs = game.payoffs;
  settings.criterion = criterion_of(values);
  settings.noise = parse_number(text_option(values, "noise"), "--noise", 0, 1);
  settings.self_play = values.count("no-self-play") == 0;
  settings.repetitions = whole_option(values, "repetitions", 100, 1, 10'000'000);
  settings.seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  settings.threads =
      static_cast<unsigned>(whole_option(values, "threads", std::max(1U, std::thread::hardware_concurrency()), 1, 256));
  auto [entrants, core] = field_of(values, game.payoffs);
  const auto extension = picture_extension(values, entrants.size());
  const auto folder = output_folder(values);
  note_unusual_payoffs("ipd-tournament", game, common);

  std::optional<Progress> progress(std::in_place, fmt::format("playing {} strategies", entrants.size()), !common.quiet);
  settings.progress = [&](double fraction) { (*progress)(fraction); };
  const Tournament result(std::move(entrants), core, settings);
  progress.reset();

  const TournamentLabels labels{text_option(values, "strategies"), text_option(values, "include"), game.title};
  if (folder) {
    write_files(*folder, result, labels);
    if (extension) draw_pictures(*folder, result, *extension);
  }
  switch (common.format) {
    case Format::text: write_text(std::cout, result, labels); break;
    case Format::csv: write_ranking_csv(std::cout, result); break;
    case Format::json: write_json(std::cout, result, labels, true); break;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::program(), {"text", "csv", "json"}, folk::tools::tournament);
}
