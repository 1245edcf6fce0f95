// sct-train: trains a self-confirming transformer and keeps the best policy it met.

#include <folk/tools/choices/checkpoint_option.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/output_file.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/threads_option.h>
#include <folk/tools/sct_train/config.h>
#include <folk/tools/sct_train/data.h>
#include <folk/tools/sct_train/output.h>
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
#include <utility>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* name = "sct-train";

Program program() {
  Program program;
  program.name = name;
  program.usage = "[options]";
  program.summary =
      "Trains a self-confirming transformer on matches of the iterated prisoner's dilemma, lets it play every so many\n"
      "steps, and writes the policy that earned most, with the return it should be asked for. Every option from data\n"
      "on may stand in a file (--config) as a line 'key = value'; the defaults are the SCT paper's.";
  program.examples = {"sct-train --hidden 64 --layers 2 --learning-rate 0.001 --warmup 100 --steps 1000",
                      "sct-train --config run.conf --seed 2 --output sct-2.bin --checkpoint run-2",
                      "sct-train --config run.conf --seed 2 --output sct-2.bin --checkpoint run-2 --resume",
                      "sct-train --data trajectories/ --roster classics --steps 5000 --format json",
                      "ipd-tournament --strategies sct2025 --include sct:policy.bin"};
  auto add = program.options.add_options();
  add("config", po::value<std::string>(), "file of lines 'key = value', # comments; options win over it");
  add("output", po::value<std::string>(), "the policy's file (default policy.bin); replaced at the end only");
  add_checkpoint_options(program.options);
  add("threads", po::value<std::string>(), "threads (default: one a processor); the results do not depend on it");
  add_train_options(program.options);
  return program;
}

/// All that the end of the run depends on, a line each.
std::string description(const TrainConfig& config, const sct::TrainingSettings& settings, std::uint64_t data) {
  std::string text = fmt::format("folk = {}\n", FOLK_VERSION);
  for (const auto& [key, value] : key_values(config))
    if (key == "decay")
      text += fmt::format("decay = {}\n", settings.optimiser.decay_steps);
    else if (key != "steps" && key != "checkpoint-every")  // a run may be made longer
      text += fmt::format("{} = {}\n", key, value);
  return text + fmt::format("the data's signature = {:016x}\n", data);
}

sct::TrainingRecord record_of(const TrainConfig& config, const sct::TrainingSettings& settings) {
  sct::TrainingRecord record;
  record.mode = settings.mode;
  record.data = config.data;
  if (config.data_is_folder()) {
    const fs::path folder = fs::path(config.data).lexically_normal();
    record.data = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  }
  record.roster = config.roster;
  record.payoffs = config.payoffs;
  record.rounds = config.rounds;
  record.criterion = Criterion::finite(config.rounds).to_string();
  record.return_scale = settings.windows.return_scale;
  record.seed = settings.seed;
  record.code_version = FOLK_VERSION;
  return record;
}

void resume(sct::TrainingRun& run, const sct::CheckpointFolder& folder, const Common& common) {
  auto checkpoint = folder.newest(
      [&](const std::string& fault) { common.note(fmt::format("note: {}; the one before is taken", fault)); });
  if (!checkpoint) return;
  run.restore(std::move(*checkpoint));
  common.note(fmt::format("resumed at step {}", run.steps()));
}

[[noreturn]] void interrupted(const sct::TrainingRun& run, const sct::CheckpointFolder* folder) {
  if (folder == nullptr)
    throw EnvironmentError(
        fmt::format("interrupted after step {}; nothing is kept without --checkpoint DIR", run.steps()));
  throw EnvironmentError(
      fmt::format("interrupted after step {}; the same command with --resume goes on from there", run.steps()));
}

/// Trains to the end. A checkpoint holds the evaluation of its step where a longer run would have it too.
void train(sct::TrainingRun& run, sct::CheckpointFolder* folder, std::uint64_t checkpoint_every,
           TrainProgress& progress) {
  std::uint64_t saved = run.steps();
  const auto save = [&] {
    if (folder != nullptr && saved != run.steps()) folder->write(run.checkpoint());
    saved = run.steps();
  };
  for (;;) {
    if (run.evaluation_due()) {
      if (run.only_due_at_the_end()) save();
      try {
        run.evaluate({nullptr, Interruption::requested});
      } catch (const Cancelled&) {
        save();
        interrupted(run, folder);
      }
      progress.evaluation(run);
    }
    if (run.steps() % checkpoint_every == 0 || run.finished() || Interruption::requested()) save();
    if (run.finished()) return;
    if (Interruption::requested()) interrupted(run, folder);
    run.step();
    progress.step(run);
  }
}

int sct_train(const po::variables_map& values, const Common& common) {
  auto config = train_config(values, text_option(values, "config"));
  const auto threads = threads_option(values, common);
  const fs::path output = text_option(values, "output", "policy.bin");
  require_writable(output, "--output");
  const auto roster = standard_names().roster(config.roster, config.payoffs);
  auto data = train_data(config, roster);
  const auto settings = training_settings(config, threads);
  auto run_plan = run_settings(config, threads);
  run_plan.description = description(config, settings, signature_of(data.lessons));

  TrainReport report;
  report.lessons = data.lessons.size();
  sct::TrainingRun run(run_plan, settings, std::move(data.lessons), roster, record_of(config, settings), data.teacher);
  const auto folder = checkpoint_folder<sct::CheckpointFolder>(values, common);
  if (folder) resume(run, *folder, common);
  {
    const Interruption interruption;
    const auto rounds = std::min<std::uint64_t>(settings.architecture.context, config.rounds);
    TrainProgress progress(!common.quiet, run.steps(), run_plan.steps,
                           settings.windows.windows * rounds * settings.architecture.round_tokens());
    train(run, folder.get(), config.checkpoint_every, progress);
  }
  const auto policy = run.policy();
  sct::write_policy(output, policy);

  report.config = std::move(config);
  report.added = run.added();
  report.history = run.history();
  report.kept = run.kept();
  report.roster = roster;
  auto clean = run_plan.validation;
  clean.noise = 0;
  report.clean = sct::play_policy(policy, roster, clean);
  report.effect = sct::belief_effect(std::make_shared<const sct::Mind>(policy), roster, threads);
  report.output = output.string();
  switch (common.format) {
    case Format::text: write_text(std::cout, report); break;
    case Format::csv: write_csv(std::cout, report); break;
    case Format::json: write_json(std::cout, report); break;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::program(), {"text", "csv", "json"}, folk::tools::sct_train);
}
