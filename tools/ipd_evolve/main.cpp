// ipd-evolve: what becomes of populations of strategies.

#include <folk/tools/choices/standard_names.h>
#include <folk/tools/choices/whole_class.h>
#include <folk/tools/ipd_evolve/class_evolution.h>
#include <folk/tools/ipd_evolve/evolution_output.h>
#include <folk/tools/ipd_evolve/fixation_output.h>
#include <folk/tools/ipd_evolve/pictures.h>
#include <folk/tools/ipd_evolve/question.h>
#include <folk/tools/ipd_evolve/run_journal.h>
#include <folk/tools/ipd_evolve/scores.h>
#include <folk/tools/ipd_evolve/solved.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/journal.h>
#include <folk/tools/program/launch.h>
#include <folk/tools/program/output_folder.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/analysis/evolution/evolution_journal.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>

#include <functional>
#include <iostream>
#include <optional>
#include <utility>

namespace folk::tools {
namespace {

Program program() {
  Program program;
  program.name = "ipd-evolve";
  program.title = "what becomes of populations of strategies";
  program.usage = "[options]";
  program.summary =
      "Lets a population of strategies evolve by what they earn against each other: the ecological competition of\n"
      "Mathieu & Delahaye in exact integers, their other models, the replicator equation, birth-death and pairwise\n"
      "comparison; and says who takes over, with which probability, and what rare mutations come to. SPEC is a\n"
      "comma list of names, rosters (classics, sct2025, all), families (memory(1,2)), genotypes\n"
      "(mem12_ccCDCDDCDD), @FILE (@- is the standard input) and exec:\"CMD\"; LABEL=NAME renames one of them.\n"
      "A complete class alone may be as large as memory(2,2). Under mpirun or srun the ranks share tournaments and\n"
      "generations of a class; the results do not depend on it.";
  program.examples = {"ipd-evolve --rounds 1000",
                      "ipd-evolve --strategies 'memory(1,2)' --rounds 1000 --format csv",
                      "ipd-evolve --strategies 'memory(2,2)' --rounds 1000 --journal memory22.journal",
                      "ipd-evolve --strategies all_c,all_d,tit_for_tat --model replicator --mutation 0.001 --output "
                      "results --plot",
                      "ipd-evolve --strategies all_d,tit_for_tat --start all_d=90,tit_for_tat=10 --runs 1000",
                      "ipd-evolve --strategies all_c,all_d,tit_for_tat --stationary --individuals 20 --exact",
                      "ipd-evolve --model encounter --generations 1000000 --journal run.journal"};
  program.shares_work = true;
  add_score_options(program.options);
  add_question_options(program.options);
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("seed", text(), "of all random numbers (default 1)");
  add("threads", text(), "threads (default: one a processor); the results do not depend on it");
  add("journal", text(), "file that is kept up to date: after a kill the same command goes on from it");
  add("output", text(), "folder for tables and summary.json");
  add("plot", text()->implicit_value("svg"),
      "svg, png or pdf: also draw populations, stack, cooperation, the simplex of three strategies, fixation into "
      "--output");
  program.registry = [] { return standard_names(); };
  return program;
}

/// What all questions need.
struct Setting {
  const PlayedScores& played;
  const EvolveQuestion& question;
  const Common& common;
  std::optional<std::filesystem::path> folder;
  std::optional<std::string> picture;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

std::uint64_t identity_with(const ScoreMatrix& scores, std::uint64_t more) {
  Signature signature;
  signature.add(scores.signature());
  signature.add(more);
  return signature.value();
}

void evolve(const Setting& setting, Journal& journal) {
  const auto& [played, question, common, folder, picture, seed, threads] = setting;
  Evolution evolution(question.dynamics, question.start, seed);
  const auto identity = identity_with(*played.scores, evolution.identity());
  run_with_journal(evolution, question.generations, journal, identity, played.scores->size(), common);
  if (!crew().first()) return;
  const EvolutionReport report{played, question, evolution, common.command};
  if (folder) write_evolution_files(*folder, report);
  if (folder && picture) draw_evolution(*folder, report, *picture);
  switch (common.format) {
    case Format::text: write_evolution_text(std::cout, report); break;
    case Format::csv: write_evolution_csv(std::cout, report); break;
    case Format::json: write_evolution_json(std::cout, report, false); break;
  }
}

void simulate(const Setting& setting, Journal& journal) {
  const auto& [played, question, common, folder, picture, seed, threads] = setting;
  FixationCounts counts;
  Signature what;
  what.add(question.dynamics->text());
  what.add(seed);
  what.add(question.generations);
  for (const double number : question.start) what.add(number);
  const auto identity = identity_with(*played.scores, what.value());
  if (const auto text = journal.read()) {
    counts = read_fixation_journal(*text, journal.name(), identity, played.scores->size());
    if (counts.runs > question.runs)
      throw UsageError(
          fmt::format("--journal {}: it holds {} runs, more than --runs {}: ask for more, or name another "
                      "file",
                      journal.name(), counts.runs, question.runs));
    common.note(fmt::format("going on from run {} of {}", counts.runs, journal.name()));
  }
  const auto text = [&] { return journal_text(counts, identity); };
  try {
    ProgressBar bar("simulating", !common.quiet);
    const Interruption interruption;
    simulate_fixation(counts, *question.dynamics, question.start, question.runs, question.generations, seed, threads,
                      {std::ref(bar), Interruption::requested}, [&] { journal.now_and_then(text); });
  } catch (const Cancelled&) {
    if (journal) journal.write(text());
    end_interrupted(bool(journal), fmt::format("{} runs", counts.runs));
  }
  if (journal) journal.write(text());
  const RunsReport report{played, question, counts, seed, common.command};
  if (folder) write_runs_files(*folder, report);
  write_runs(std::cout, report, common.format);
}

void solve(const Setting& setting) {
  const auto& [played, question, common, folder, picture, seed, threads] = setting;
  if (picture) require_fixation_picture(played.scores->size());
  std::optional<ProgressBar> bar(std::in_place, "fixation", !common.quiet);
  FixationReport report = solved(played, question, seed, threads, std::ref(*bar));
  bar.reset();
  report.command = common.command;
  if (folder) write_fixation_files(*folder, report);
  if (folder && picture) draw_fixation(*folder, report, *picture);
  write_fixation(std::cout, report, common.format);
}

int run_question(const po::variables_map& values, const Common& common) {
  check_question(values);
  if (const auto members = unlisted_class(text_option(values, "strategies")))
    return evolve_class(*members, values, common);
  const auto seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  const unsigned threads = threads_option(values, common);
  const auto picture = chosen_picture(values);
  const auto folder = output_folder(values);
  Journal journal = journal_option(values);
  const PlayedScores played = [&] {
    ProgressBar bar("playing", !common.quiet);
    return chosen_scores(values, common, seed, threads, std::ref(bar));
  }();
  const EvolveQuestion question = chosen_question(values, played.scores);
  const Setting setting{played, question, common, folder, picture, seed, threads};
  // Only the scores and the generations of a class are shared work.
  if (question.question != Question::evolution && !crew().first()) return done;
  switch (question.question) {
    case Question::evolution: evolve(setting, journal); break;
    case Question::runs: simulate(setting, journal); break;
    case Question::fixation:
    case Question::stationary: solve(setting); break;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::program(), {"text", "csv", "json"}, folk::tools::run_question);
}
