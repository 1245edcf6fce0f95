// sct-train: trains a self-confirming transformer and keeps the best policy it met.

#include <folk/tools/choices/checkpoint_option.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/output_file.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/threads_option.h>
#include <folk/tools/sct_train/begun_run.h>
#include <folk/tools/sct_train/config.h>
#include <folk/tools/sct_train/output.h>
#include <folk/tools/sct_train/seeds.h>
#include <folk/tools/sct_train/seeds_output.h>
#include <folk/tools/sct_train/training_log.h>
#include <folk/tools/sct_train/training_progress.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/sct/policy/policy_file.h>
#include <folk/sct/training/checkpoint_folder.h>
#include <folk/sct/training/training_run.h>
#include <folk/sct/training/validation.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* name = "sct-train";

Program program() {
  Program program;
  program.name = name;
  program.title = "trains a self-confirming transformer and keeps the best policy";
  program.usage = "[options]";
  program.summary =
      "Trains a self-confirming transformer on matches of the iterated prisoner's dilemma, or of another symmetric "
      "2x2\n"
      "game (--game), lets it play every so many\n"
      "steps, and writes the policy that earned most, with the return it should be asked for. Every option from data\n"
      "on may stand in a file (--config) as a line 'key = value'; the defaults are the SCT paper's, where it states "
      "one.";
  program.examples = {"sct-train --hidden 64 --layers 2 --learning-rate 0.001 --warmup 100 --steps 1000",
                      "sct-train --config run.conf --seed 2 --output sct-2.bin --checkpoint run-2",
                      "sct-train --config run.conf --seed 2 --output sct-2.bin --checkpoint run-2 --resume",
                      "sct-train --config run.conf --seeds 1..5 --output sct.bin --log sct.csv --checkpoint runs",
                      "sct-train --config run.conf --held-out 'winner12,winner21,per_cccd' --patience 4",
                      "sct-train --game examples/stag_hunt.nfg --output stag.bin",
                      "sct-train --data trajectories/ --roster classics --steps 5000 --format json",
                      "ipd-tournament --strategies sct2025 --include sct:policy.bin"};
  auto add = program.options.add_options();
  add("config", po::value<std::string>(), "file of lines 'key = value', # comments; options win over it");
  add("output", po::value<std::string>(), "the policy's file (default policy.bin); replaced at the end only");
  add("log", po::value<std::string>(), "a CSV file with a row an evaluation, written while it runs");
  add("seeds", po::value<std::string>(),
      "one policy a seed, as 1..5 or 1,4,9: sct.bin becomes sct-1.bin, a log likewise, DIR becomes DIR/seed-1");
  add_checkpoint_options(program.options);
  add("threads", po::value<std::string>(), "threads (default: one a processor); the results do not depend on it");
  add_train_options(program.options);
  program.registry = [] { return standard_names(); };
  return program;
}

void resume(sct::TrainingRun& run, const sct::CheckpointFolder& folder, const Common& common) {
  auto checkpoint = folder.newest(
      [&](const std::string& fault) { common.note(fmt::format("note: {}; the one before is taken", fault)); });
  if (!checkpoint) return;
  run.restore(std::move(*checkpoint));
  common.note(fmt::format("resumed at step {}", run.steps()));
}

/// Where one policy's run keeps what it writes.
struct RunFiles {
  fs::path output;
  fs::path log;                                          ///< empty: none
  std::unique_ptr<sct::CheckpointFolder> checkpoints{};  ///< null: none
  std::string label{};                                   ///< "seed 3, " where there are several runs
};

[[noreturn]] void interrupted(const sct::TrainingRun& run, const RunFiles& files) {
  if (files.checkpoints == nullptr)
    throw EnvironmentError(
        fmt::format("{}interrupted after step {}; nothing is kept without --checkpoint DIR", files.label, run.steps()));
  throw EnvironmentError(fmt::format("{}interrupted after step {}; the same command with --resume goes on from there",
                                     files.label, run.steps()));
}

/// Trains to the end. A checkpoint holds the evaluation of its step where a longer run would have it too.
void train(sct::TrainingRun& run, const RunFiles& files, std::uint64_t checkpoint_every, TrainProgress& progress,
           TrainingLog* log) {
  std::uint64_t saved = run.steps();
  const auto save = [&] {
    if (files.checkpoints && saved != run.steps()) files.checkpoints->write(run.checkpoint());
    saved = run.steps();
  };
  for (;;) {
    if (run.evaluation_due()) {
      if (run.only_due_at_the_end()) save();
      try {
        run.evaluate({nullptr, Interruption::requested});
      } catch (const Cancelled&) {
        save();
        interrupted(run, files);
      }
      progress.evaluation(run);
      if (log != nullptr) log->evaluation(run);
    }
    if (run.steps() % checkpoint_every == 0 || run.finished() || Interruption::requested()) save();
    if (run.finished()) return;
    if (Interruption::requested()) interrupted(run, files);
    run.step();
    progress.step(run);
  }
}

TrainReport train_policy(TrainConfig config, const RunFiles& files, unsigned threads, const Common& common) {
  TrainReport report;
  BegunRun begun = begin_run(config, threads, common);
  sct::TrainingRun& run = begun.run;
  if (files.checkpoints) resume(run, *files.checkpoints, common);
  std::optional<TrainingLog> log;
  if (!files.log.empty()) log.emplace(files.log, run, config.holds_out());
  {
    const Interruption interruption;
    const auto& settings = begun.training;
    const auto rounds = std::min<std::uint64_t>(settings.architecture.context, config.rounds);
    TrainProgress progress(!common.quiet, files.label, run.steps(), begun.plan.steps,
                           settings.windows.windows * rounds * settings.architecture.round_tokens());
    train(run, files, config.checkpoint_every, progress, log ? &*log : nullptr);
  }
  const auto policy = finished_policy(begun, config);
  sct::write_policy(files.output, policy);
  if (log) log->close(run);

  report.lessons = config.explores() ? run.explored() : begun.lessons;
  report.config = std::move(config);
  report.added = run.added();
  report.history = run.history();
  report.kept = run.kept();
  report.stopped_early = run.stopped_early();
  report.roster = begun.roster;
  report.held_out = begun.plan.held_out;
  auto clean = begun.plan.validation;
  clean.noise = 0;
  report.clean = sct::play_policy(policy, report.roster, clean);
  if (!report.held_out.empty()) report.clean_held_out = sct::play_policy(policy, report.held_out, clean);
  report.effect = sct::belief_effect(std::make_shared<const sct::Mind>(policy), report.roster, threads);
  report.output = files.output.string();
  return report;
}

/// The seeds of --seeds; nothing where the config's is the only one.
std::optional<std::vector<std::uint64_t>> seeds_option(const po::variables_map& values) {
  if (values.count("seeds") == 0) return std::nullopt;
  if (values.count("seed") != 0) throw UsageError("--seed and --seeds: give the one or the other");
  return parse_seeds(text_option(values, "seeds"));
}

/// The log must not take the place of what else a run reads or writes.
void require_own_name(const fs::path& log, const fs::path& other, const char* option) {
  std::error_code error;
  if (!log.empty() && !other.empty() && fs::weakly_canonical(log, error) == fs::weakly_canonical(other, error) &&
      !error)
    throw UsageError(
        fmt::format("--log {}: it is the file of {} too; name another", excerpt(log.string(), 1000), option));
}

/// Refuses before the work what could not be kept after it.
RunFiles run_files(const po::variables_map& values, const Common& common, std::optional<std::uint64_t> seed) {
  RunFiles files{text_option(values, "output", "policy.bin"), text_option(values, "log")};
  fs::path inside;
  if (seed) {
    files.output = of_seed(files.output, *seed);
    if (!files.log.empty()) files.log = of_seed(files.log, *seed);
    inside = fmt::format("seed-{}", *seed);
    files.label = fmt::format("seed {}, ", *seed);
  }
  require_writable(files.output, "--output");
  if (!files.log.empty()) require_writable(files.log, "--log");
  require_own_name(files.log, files.output, "--output");
  require_own_name(files.log, text_option(values, "config"), "--config");
  files.checkpoints = checkpoint_folder<sct::CheckpointFolder>(values, common, inside);
  return files;
}

int sct_train(const po::variables_map& values, const Common& common) {
  for (const char* file : {"config", "log"})
    if (values.count(file) != 0 && text_option(values, file).empty())
      throw UsageError(fmt::format("--{} '': expected the name of a file", file));
  const auto config = train_config(values, text_option(values, "config"));
  const auto threads = threads_option(values, common);
  const auto seeds = seeds_option(values);
  if (!seeds) {
    const auto checked = with_seed(config, config.training.seed);
    const auto report = train_policy(checked, run_files(values, common, std::nullopt), threads, common);
    switch (common.format) {
      case Format::text: write_text(std::cout, report); break;
      case Format::csv: write_csv(std::cout, report); break;
      case Format::json: write_json(std::cout, report); break;
    }
    return done;
  }
  std::vector<TrainConfig> configs;
  for (const auto seed : *seeds) configs.push_back(with_seed(config, seed));
  std::vector<RunFiles> files;
  for (const auto seed : *seeds) files.push_back(run_files(values, common, seed));
  std::vector<TrainReport> reports;
  for (std::size_t i = 0; i < configs.size(); ++i)
    reports.push_back(train_policy(configs[i], files[i], threads, common));
  switch (common.format) {
    case Format::text: write_seeds_text(std::cout, reports); break;
    case Format::csv: write_seeds_csv(std::cout, reports); break;
    case Format::json: write_seeds_json(std::cout, reports); break;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::program(), {"text", "csv", "json"}, folk::tools::sct_train);
}
