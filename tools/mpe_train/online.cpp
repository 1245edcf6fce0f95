#include <folk/tools/mpe_train/online.h>

#include <folk/tools/choices/checkpoint_option.h>
#include <folk/tools/choices/scenario_option.h>
#include <folk/tools/mpe_train/online_options.h>
#include <folk/tools/mpe_train/online_output.h>
#include <folk/tools/program/data_folder.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/output_file.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/online/online_checkpoint.h>
#include <folk/mpe/players/names.h>
#include <folk/mpe/players/scripted.h>
#include <folk/sct/files/checkpoint_files.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <utility>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;
using mpe::OnlineTraining;
using mpe::Side;

constexpr const char* online_name = "mpe-train online";

Program online_program() {
  Program program;
  program.name = online_name;
  program.title = "trains predators, or all agents, by MATD3 or MADDPG";
  program.usage = "[options]";
  program.summary =
      "Trains the predators of the particle world by MATD3 or MADDPG against a prey, or all four agents together, and\n"
      "writes the policy of the evaluation with the highest return. Beside it a CSV of all evaluations, written while\n"
      "it runs, and their picture.";
  program.examples = {
      "mpe-train online --scenario simple_tag --seed 1 --output predators.safetensors",
      "mpe-train online --scenario simple_world --algorithm maddpg --episodes 30000 --output world.safetensors",
      "mpe-train online --prey learn --output predators.safetensors --prey-output prey.safetensors",
      "mpe-train online --output p.safetensors --checkpoint run-1          # and after an interruption",
      "mpe-train online --output p.safetensors --checkpoint run-1 --resume",
      "mpe-evaluate --scenario simple_tag --predators predators.safetensors --prey released,still"};
  auto add = program.options.add_options();
  add_scenario_options(program.options);
  add("prey", po::value<std::string>(), "who plays it, a name or a policy file (default released), or learn");
  add_online_options(program.options);
  add("threads", po::value<std::string>(), "threads (default: one a processor); the results do not depend on it");
  add("output", po::value<std::string>(), "the predators' policy (default predators.safetensors)");
  add("medium", po::value<std::string>(), "file for the policy nearest half the best one's normalised score");
  add("prey-output", po::value<std::string>(), "file for the prey's policy, where it learns");
  add("curve", po::value<std::string>(), "file for the evaluations (default: the output's name with .csv)");
  add("picture", po::value<std::string>(), ".svg, .png or .pdf of them (default: the output's name with .svg)");
  add("checkpoint-every", po::value<std::string>(), "episodes between checkpoints (default 6400)");
  add_checkpoint_options(program.options);
  return program;
}

/// Where a run's results go.
struct OnlineFiles {
  fs::path output, curve, picture;
  fs::path medium, prey;  // empty where not asked for
  bool draws = true;
};

OnlineFiles files_of(const po::variables_map& values, bool prey_learns) {
  OnlineFiles files;
  files.output = text_option(values, "output", "predators.safetensors");
  files.curve = text_option(values, "curve", fs::path(files.output).replace_extension(".csv").string());
  files.picture = text_option(values, "picture", fs::path(files.output).replace_extension(".svg").string());
  files.medium = text_option(values, "medium");
  files.prey = text_option(values, "prey-output");
  if (!files.prey.empty() && !prey_learns)
    throw UsageError("--prey-output: the prey does not learn in this run; give --prey learn, or leave it out");
  if (!files.medium.empty() && prey_learns)
    throw UsageError("--medium: scores against a prey that learns do not compare; name a prey that stays as it is");
  if (files.output.empty()) throw UsageError("--output: name the file of the predators' policy");
  for (const auto& [option, file] : {std::pair{"--output", files.output},
                                     {"--curve", files.curve},
                                     {"--picture", files.picture},
                                     {"--medium", files.medium},
                                     {"--prey-output", files.prey}})
    if (!file.empty()) require_writable(file, option);
  std::vector<fs::path> all{files.output, files.curve, files.picture};
  for (const auto& file : {files.medium, files.prey})
    if (!file.empty()) all.push_back(file);
  std::sort(all.begin(), all.end());
  if (const auto twice = std::adjacent_find(all.begin(), all.end()); twice != all.end())
    throw UsageError(fmt::format("{}: two results would go to this file", excerpt(twice->string(), 1000)));
  gnuplot::picture_format(files.picture);
  try {
    gnuplot::require_gnuplot();
  } catch (const RendererMissing&) {
    if (values.count("picture") != 0) throw;
    files.draws = false;
  }
  return files;
}

/// The prey's name, and of a file what is in it: a run resumed against another prey is another run.
std::string described_prey(const mpe::Controller& prey) {
  if (prey.file.empty()) return prey.name;
  Signature signature;
  signature.add(read_file(prey.file, mpe::largest_policy_file));
  return fmt::format("file with signature {:016x}", signature.value());
}

void write_curve(const fs::path& file, const OnlineTraining& training) {
  write_file(file, [&](std::ostream& out) { write_evaluations(out, training.history()); });
}

/// A return that has half the normalised score of the best: half way from random predators' to its.
double half_way(const OnlineTraining& training, const mpe::Controller& prey, double best) {
  const auto& settings = training.settings();
  const mpe::Layout layout(training.scenario());
  const auto scores = score_episodes(layout, {mpe::random_player(), prey},
                                     {settings.evaluation_seed, 0, settings.evaluation_episodes, settings.threads});
  double random = 0;
  for (const auto& score : scores) random += score.predators / static_cast<double>(scores.size());
  return (random + best) / 2;
}

class OnlineRun {
public:
  OnlineRun(OnlineTraining& training, const OnlineFiles& files, sct::CheckpointFiles* folder, std::string description,
            std::uint64_t checkpoint_every, const Common& common)
      : training_(training),
        files_(files),
        folder_(folder),
        description_(std::move(description)),
        checkpoint_every_(checkpoint_every),
        common_(common) {}

  void resume() {
    if (folder_ == nullptr) return;
    const auto note = [&](const std::string& fault) {
      common_.note(fmt::format("note: {}; the one before is taken", fault));
    };
    const bool found =
        folder_->read_newest([&](std::string_view bytes,
                                 const std::string& source) { mpe::restore(training_, bytes, source, description_); },
                             note);
    saved_ = training_.episodes();
    if (found) common_.note(fmt::format("resumed at episode {}", training_.episodes()));
  }

  void train() {
    const Interruption interruption;
    ProgressBar progress("training", !common_.quiet);
    const double first = static_cast<double>(training_.episodes());
    const double all = std::max(1.0, static_cast<double>(training_.settings().episodes) - first);
    for (;;) {
      if (training_.evaluation_due()) {
        training_.evaluate();
        write_curve(files_.curve, training_);
      }
      if (training_.finished()) return save();
      if (training_.episodes() - saved_ >= checkpoint_every_) save();
      if (Interruption::requested()) interrupted();
      training_.round();
      progress((static_cast<double>(training_.episodes()) - first) / all);
    }
  }

private:
  void save() {
    if (folder_ != nullptr && saved_ != training_.episodes())
      folder_->write_bytes(training_.episodes(), online_checkpoint(training_, description_));
    saved_ = training_.episodes();
  }

  [[noreturn]] void interrupted() {
    save();
    throw EnvironmentError(
        folder_ == nullptr
            ? fmt::format("interrupted after episode {}; nothing is kept without --checkpoint DIR",
                          training_.episodes())
            : fmt::format("interrupted after episode {}; the same command with --resume goes on from there",
                          training_.episodes()));
  }

  OnlineTraining& training_;
  const OnlineFiles& files_;
  sct::CheckpointFiles* folder_;
  std::string description_;
  std::uint64_t checkpoint_every_;
  const Common& common_;
  std::uint64_t saved_ = 0;
};

/// A policy with how it was made; the same run gives the same bytes.
mpe::Policy noted(const OnlineTraining& training, std::size_t evaluation, Side side, const std::string& description) {
  const auto& standing = training.history()[evaluation];
  auto policy = training.policy(standing, side);
  policy.notes = {{"training", description},
                  {"episodes", fmt::to_string(standing.episodes)},
                  {"updates", fmt::to_string(standing.updates)},
                  {"evaluated return", fmt::format("{}", side == Side::prey ? standing.prey : standing.predators)},
                  {"folk", FOLK_VERSION}};
  return policy;
}

int online(const po::variables_map& values, const Common& common) {
  const auto scenario = chosen_scenario(values);
  auto settings = online_settings(values);
  settings.threads = threads_option(values, common);
  const auto spec = text_option(values, "prey", "released");
  settings.prey_learns = spec == "learn";
  const auto files = files_of(values, settings.prey_learns);
  const auto prey =
      settings.prey_learns ? mpe::still_player() : mpe::controller(spec, Side::prey, scenario, data_folder() / "mpe");
  OnlineTraining training(scenario, settings, prey);
  const auto text = mpe::description(training, described_prey(prey));
  const auto checkpoint_every = whole_option(values, "checkpoint-every", 6400, 1, 1'000'000'000);
  const auto folder = checkpoint_folder<sct::CheckpointFiles>(values, common);

  OnlineRun one(training, files, folder.get(), text, checkpoint_every, common);
  one.resume();
  one.train();

  OnlineReport report{training, text, kept_evaluation(training), std::nullopt, files.output, files.curve, {}, {}, {}};
  mpe::write_policy(files.output, noted(training, report.kept, Side::predators, text));
  if (!files.medium.empty()) {
    report.medium = nearest_evaluation(training, half_way(training, prey, training.history()[report.kept].predators));
    mpe::write_policy(files.medium, noted(training, *report.medium, Side::predators, text));
    report.medium_file = files.medium;
  }
  if (!files.prey.empty()) {
    mpe::write_policy(files.prey, noted(training, report.kept, Side::prey, text));
    report.prey_file = files.prey;
  }
  write_curve(files.curve, training);
  if (files.draws) {
    draw_evaluations(training, report.kept, files.picture);
    report.picture = files.picture;
  } else {
    common.note("note: no picture of the evaluations is drawn, gnuplot is not installed: apt-get install gnuplot-nox");
  }
  write_report(std::cout, report, common.format);
  return done;
}

}  // namespace

int mpe_online(int argc, char** argv) { return run(argc, argv, online_program(), {"text", "csv", "json"}, online); }

}  // namespace folk::tools
