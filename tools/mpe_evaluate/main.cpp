// mpe-evaluate: what predators earn against a prey, and whether recorded episodes are what this world does.

#include <folk/tools/choices/scenario_option.h>
#include <folk/tools/mpe_evaluate/output.h>
#include <folk/tools/mpe_evaluate/play.h>
#include <folk/tools/mpe_evaluate/replay.h>
#include <folk/tools/program/data_folder.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/output_file.h>
#include <folk/tools/program/output_folder.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/mpe/evaluation/numpy_starts.h>
#include <folk/mpe/evaluation/recording_file.h>
#include <folk/mpe/pictures/draw_episode.h>
#include <folk/mpe/players/names.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <system_error>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_episodes = 10'000'000;
constexpr std::uint64_t most_numpy_episodes = 1'000'000;

Program mpe_evaluate() {
  Program program;
  program.name = "mpe-evaluate";
  program.title = "what predators earn against a prey in the particle world";
  program.usage = "--predators PLAYER [options] | --replay FILE.csv[,...] [options]";
  program.summary =
      "Plays episodes of the particle world and says what the predators earn against each prey; or plays recorded\n"
      "episodes again and says how far they deviate. A PLAYER is a name (still, random, blend(0.5), lead_pursuit,\n"
      "greedy_pursuit, expert, medium; of the prey released, maddpg), a policy FILE or exec:\"COMMAND\".";
  program.examples = {"mpe-evaluate --predators lead_pursuit",
                      "mpe-evaluate --scenario simple_world --predators expert --prey \"released,still,blend(0.5)\"",
                      "mpe-evaluate --predators lead_pursuit --episodes 10 --render episode.svg --record episode.csv",
                      "mpe-evaluate --predators mine.safetensors --prey random --episodes 1000 --format json",
                      "mpe-evaluate --predators sct.safetensors --prey released,still --targets 0:480:40 --beliefs",
                      "mpe-evaluate --replay episode.csv --free-run --tolerance 1e-9"};
  program.claim = "a replay deviates by more than the tolerance";
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add_scenario_options(program.options);
  add("predators", text(), "the player of all three predators");
  add("prey", text(), "the prey, or a comma list to meet one after the other (default released)");
  add("episodes", text(), "with each prey (default 100)");
  add("seed", text(), "of all random numbers (default 1)");
  add("numpy-seed", text(), "place everything as the published program after numpy.random.seed(N): a reset an episode");
  add("threads", text(), "threads (default: one a processor); the results do not depend on it");
  add("references", text(),
      "what counts as 100 and 0: published, measured, or the two returns EXPERT,RANDOM (default: published for the "
      "released prey, measured for others)");
  add("targets", text(),
      "returns that a transformer is asked for, LOW:HIGH:STEP or a comma list: each prey's best, found on other "
      "episodes, is played (default: what its data earned)");
  add("selection-seed", text(), "of the episodes on which the best is found (default: the seed + 1000000)");
  add("beliefs", "say how often a transformer's beliefs are right");
  add("force-beliefs", "play again with its beliefs forced to the truth, to another episode's, to zero");
  add("output", text(), "folder for results.csv, results.json, episodes.csv");
  add("record", text(), "write one episode, step by step, to FILE.csv");
  add("render", text(), "draw one episode: FILE.svg (animated), FILE.png or FILE.pdf (a filmstrip)");
  add("episode", text(), "which one is recorded and drawn, counted from 0 (default 0)");
  add("replay", text(), "play the recorded episodes of FILE.csv[,FILE2.csv,...] again and compare");
  add("free-run", "replay whole episodes from their first states, not each step from its own");
  add("tolerance", text(), "how far a replay may deviate (default 1e-12)");
  return program;
}

/// Refuses options that only the other way of using the program has.
void refuse_options(const po::variables_map& values, std::initializer_list<const char*> names, const char* why) {
  for (const char* name : names)
    if (values.count(name) != 0) throw UsageError(fmt::format("--{}: {}", name, why));
}

void choose_references(EvaluationSettings& settings, const po::variables_map& values) {
  if (values.count("references") == 0) return;
  const std::string text = text_option(values, "references");
  for (const auto source : {mpe::ReferenceSource::published, mpe::ReferenceSource::measured})
    if (text == to_string(source)) settings.source = source;
  if (settings.source == mpe::ReferenceSource::published && settings.scenario.rewards.rule != mpe::RewardRule::program)
    throw UsageError("--references published: they are of the program's rewards; leave out --reward-rule paper");
  if (settings.source) return;
  const auto comma = text.find(',');
  if (comma == std::string::npos)
    throw UsageError(
        fmt::format("--references '{}': expected published, measured or two returns as in 185.6,-4.1", excerpt(text)));
  const auto number = [&](const std::string& part) { return parse_number(part, "--references", -1e9, 1e9); };
  settings.source = mpe::ReferenceSource::given;
  settings.given = {number(text.substr(0, comma)), number(text.substr(comma + 1)), mpe::ReferenceSource::given};
  if (!mpe::normalised_score(0, settings.given))
    throw UsageError(fmt::format("--references '{}': the expert must earn other than random play", excerpt(text)));
}

/// "0:480:20" or "0,100,250".
std::vector<double> targets_of(const std::string& text) {
  constexpr std::size_t most_targets = 1000;
  const auto number = [&](const std::string& part) { return parse_number(part, "--targets", -1e6, 1e6); };
  std::vector<double> targets;
  if (const auto colon = text.find(':'); colon != std::string::npos) {
    const auto second = text.find(':', colon + 1);
    if (second == std::string::npos)
      throw UsageError(fmt::format("--targets '{}': expected LOW:HIGH:STEP, as in 0:480:20", excerpt(text)));
    const double low = number(text.substr(0, colon));
    const double high = number(text.substr(colon + 1, second - colon - 1));
    const double step = number(text.substr(second + 1));
    if (!(step > 0) || high < low || (high - low) / step >= static_cast<double>(most_targets))
      throw UsageError(
          fmt::format("--targets '{}': expected LOW <= HIGH and a STEP above 0 that makes at most {} of them",
                      excerpt(text), most_targets));
    // Counted first: beside a large LOW a small STEP adds nothing. A HIGH that rounding alone keeps away is reached.
    const auto steps = static_cast<std::size_t>((high - low) / step + 1e-9);
    for (std::size_t i = 0; i <= steps; ++i) targets.push_back(low + step * static_cast<double>(i));
    return targets;
  }
  if (text.find_first_not_of(", ") == std::string::npos)
    throw UsageError("--targets: no return is named; give LOW:HIGH:STEP or a comma list, as in 0:480:20");
  for (const auto& part : mpe::split_names(text)) targets.push_back(number(part));
  if (targets.size() > most_targets)
    throw UsageError(fmt::format("--targets: {} of them, at most {} are tried", targets.size(), most_targets));
  return targets;
}

EvaluationSettings settings_of(const po::variables_map& values, const Common& common) {
  EvaluationSettings settings;
  settings.scenario = chosen_scenario(values);
  settings.predators = text_option(values, "predators");
  settings.preys = mpe::split_names(text_option(values, "prey", "released"));
  settings.plan.seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  settings.plan.episodes = whole_option(values, "episodes", 100, 1, most_episodes);
  settings.plan.threads = threads_option(values, common);
  settings.data = data_folder() / "mpe";
  if (values.count("numpy-seed") != 0) {
    settings.numpy_seed = static_cast<std::uint32_t>(whole_option(values, "numpy-seed", 0, 0, 0xFFFF'FFFF));
    if (settings.plan.episodes > most_numpy_episodes)
      throw UsageError(fmt::format("--numpy-seed with --episodes {}: at most {} are placed one after the other",
                                   settings.plan.episodes, most_numpy_episodes));
    settings.plan.place =
        mpe::placed_at(mpe::numpy_starts(settings.scenario, *settings.numpy_seed, settings.plan.episodes));
  }
  choose_references(settings, values);
  if (values.count("targets") != 0) settings.targets = targets_of(text_option(values, "targets"));
  if (values.count("selection-seed") != 0 && settings.targets.empty())
    throw UsageError("--selection-seed: of the episodes on which a target is chosen; give --targets");
  settings.selection_seed =
      whole_option(values, "selection-seed", settings.plan.seed + 1'000'000, 0, ~std::uint64_t{0});
  if (!settings.targets.empty() && settings.selection_seed == settings.plan.seed)
    throw UsageError("--selection-seed: a target chosen on the very episodes that are reported flatters; give another");
  settings.beliefs = values.count("beliefs") != 0;
  settings.forced_beliefs = values.count("force-beliefs") != 0;
  return settings;
}

/// One episode that is looked at more closely.
struct CloseLook {
  std::optional<fs::path> record;
  std::optional<fs::path> picture;
  std::size_t episode = 0;
  bool wanted() const { return record || picture; }
};

CloseLook close_look(const po::variables_map& values, const EvaluationSettings& settings) {
  CloseLook look;
  if (values.count("record") != 0) look.record = text_option(values, "record");
  if (values.count("render") != 0) look.picture = text_option(values, "render");
  if (!look.wanted()) {
    refuse_options(values, {"episode"},
                   "which episode is recorded or drawn: give --record FILE.csv or --render FILE.svg");
    return look;
  }
  if (settings.preys.size() > 1)
    throw UsageError(fmt::format("--{}: one episode of one prey can be {}; give a single --prey",
                                 look.record ? "record" : "render", look.record ? "recorded" : "drawn"));
  if (look.record == look.picture) throw UsageError("--record and --render name the same file");
  look.episode = whole_option(values, "episode", 0, 0, settings.plan.episodes - 1);
  if (look.record) require_writable(*look.record, "--record");
  if (look.picture) mpe::require_drawable(*look.picture);
  return look;
}

/// Refuses an --output that could not be written after all episodes, and leaves nothing behind: an interrupted run has
/// made no folder.
void try_output_folder(const po::variables_map& values) {
  std::vector<fs::path> missing;  // innermost first
  std::error_code ignored;
  for (fs::path folder = text_option(values, "output"); !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path())
    missing.push_back(folder);
  const auto remove = [&] {
    for (const auto& folder : missing) fs::remove(folder, ignored);
  };
  try {
    output_folder(values);
  } catch (...) {
    remove();
    throw;
  }
  remove();
}

void write_results(const po::variables_map& values, const EvaluationSettings& settings, const CloseLook& look,
                   Evaluation& evaluation) {
  std::optional<mpe::EpisodeRecord> record;
  if (look.wanted()) record = record_again(settings, look.episode, evaluation);
  const Interruption waits;  // for whole files
  if (look.record) mpe::write_recording(*look.record, std::span(&*record, 1));
  if (look.picture) mpe::draw_episode(*record, *look.picture);
  if (const auto folder = output_folder(values)) write_files(*folder, settings, evaluation);
}

int evaluate_players(const po::variables_map& values, const Common& common) {
  refuse_options(values, {"free-run", "tolerance"}, "this is of recorded episodes: give --replay FILE.csv");
  if (values.count("predators") == 0)
    throw UsageError(
        "--predators is missing: name a player (lead_pursuit, random, expert, ...), a policy FILE or "
        "exec:\"COMMAND\"; or give --replay FILE.csv");
  const EvaluationSettings settings = settings_of(values, common);
  const CloseLook look = close_look(values, settings);
  try_output_folder(values);
  Evaluation evaluation = [&] {
    ProgressBar progress("playing", !common.quiet);
    return evaluate(settings, std::ref(progress));
  }();
  write_results(values, settings, look, evaluation);
  switch (common.format) {
    case Format::text: write_text(std::cout, settings, evaluation); break;
    case Format::csv: write_csv(std::cout, settings, evaluation); break;
    case Format::json: write_json(std::cout, settings, evaluation); break;
  }
  return done;
}

int replay(const po::variables_map& values, const Common& common) {
  refuse_options(values,
                 {"scenario", "predators", "prey", "episodes", "seed", "numpy-seed", "threads", "references", "output",
                  "record", "render", "episode", "targets", "selection-seed", "beliefs", "force-beliefs"},
                 "a replay plays what the file recorded; leave out this option or --replay");
  ReplaySettings settings;
  settings.files = mpe::split_names(text_option(values, "replay"));
  settings.mode = values.count("free-run") != 0 ? mpe::ReplayMode::free_run : mpe::ReplayMode::one_step;
  settings.rewards = chosen_reward_rule(values);
  settings.tolerance = parse_number(text_option(values, "tolerance", "1e-12"), "--tolerance", 0, 1e100);
  const auto files = [&] {
    ProgressBar progress("replaying", !common.quiet);
    return replay_files(settings, std::ref(progress));
  }();
  write_replay(std::cout, common.format, settings, files);
  return within(settings, files) ? done : claim_fails;
}

int run_mpe_evaluate(const po::variables_map& values, const Common& common) {
  return values.count("replay") != 0 ? replay(values, common) : evaluate_players(values, common);
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::mpe_evaluate(), {"text", "csv", "json"},
                          folk::tools::run_mpe_evaluate);
}
