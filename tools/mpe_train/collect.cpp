#include <folk/tools/mpe_train/collect.h>

#include <folk/tools/choices/scenario_option.h>
#include <folk/tools/mpe_train/data_output.h>
#include <folk/tools/program/data_folder.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/mpe/data/collect.h>
#include <folk/mpe/players/names.h>
#include <folk/mpe/players/noisy.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <string>

namespace folk::tools {
namespace {

constexpr const char* collect_name = "mpe-train collect";
constexpr std::uint64_t most_transitions = 100'000'000'000;

Program collect_program() {
  Program program;
  program.name = collect_name;
  program.title = "plays episodes and stores them as an offline data set";
  program.usage = "--output DIR (--level LEVEL | --predators PLAYER) [options]";
  program.summary =
      "Plays episodes of the particle world and writes every step as a data set for offline learners: obs_i, acs_i,\n"
      "rews_i, next_obs_i, dones_i .npy for agents i = 0..3 and metadata.json. The same options give the same bytes "
      "for\n"
      "any number of threads; the folder is whole or not there.";
  program.examples = {
      "mpe-train collect --scenario simple_tag --level expert --noise 0.1 --output data/tag-expert",
      "mpe-train collect --predators lead_pursuit --prey maddpg --transitions 25000 --output pursuit",
      "mpe-train collect --scenario simple_world --level random --dtype float64 --output world --resume"};
  auto add = program.options.add_options();
  add_scenario_options(program.options);
  add("level", po::value<std::string>(),
      "random (freshly initialised networks), medium or expert (the shipped policies) as predators");
  add("predators", po::value<std::string>(), "instead of a level: a player's name, a policy file, exec:\"CMD\"");
  add("prey", po::value<std::string>()->default_value("released"), "likewise");
  add("noise", po::value<std::string>()->default_value("0"),
      "standard deviation of what is added to the predators' actions, then cut to [-1, 1]");
  add("transitions", po::value<std::string>()->default_value("1000000"), "rows; a multiple of 25, an episode's steps");
  add("seed", po::value<std::string>()->default_value("1"), "of the episodes, the noise, the random level's networks");
  add("first-episode", po::value<std::string>()->default_value("0"), "where in the seed's episodes to begin");
  add("dtype", po::value<std::string>()->default_value("float32"), "float32 or float64");
  add("output", po::value<std::string>(), "the folder to make");
  add("resume", "go on with what an interrupted run of the same command left; be content with a finished one");
  add("threads", po::value<std::string>(), "threads (default: one a processor); the files do not depend on it");
  return program;
}

/// What --predators or the level says.
std::string predators_of(const po::variables_map& values, std::uint64_t seed) {
  const std::string level = text_option(values, "level");
  if (values.count("predators") != 0) {
    if (!level.empty()) throw UsageError("--level and --predators both say who the predators are: give one of them");
    return text_option(values, "predators");
  }
  if (values.count("level") == 0) throw UsageError("who are the predators? Give --level or --predators");
  if (level == "random") return fmt::format("untrained({})", seed);
  if (level == "medium" || level == "expert") return level;
  throw UsageError(
      fmt::format("--level '{}': expected random, medium or expert; name players by --predators", excerpt(level)));
}

sct::NpyType type_of(const po::variables_map& values) {
  const std::string dtype = text_option(values, "dtype");
  if (dtype == "float32") return sct::NpyType::float32;
  if (dtype == "float64") return sct::NpyType::float64;
  throw UsageError(fmt::format("--dtype '{}': expected float32 or float64", excerpt(dtype)));
}

/// All but who plays.
mpe::DataDescription description_of(const po::variables_map& values, const mpe::Scenario& scenario) {
  mpe::DataDescription description;
  description.folk_version = FOLK_VERSION;
  description.scenario = scenario.name;
  description.reward_rule = scenario.rewards.rule;
  description.level = text_option(values, "level");
  description.noise = parse_number(text_option(values, "noise"), "--noise", 0, 100);
  // Seeds and episodes' numbers below 2^53 stay whole in every JSON reader.
  description.seed = whole_option(values, "seed", 1, 0, std::uint64_t{1} << 53U);
  description.first_episode = whole_option(values, "first-episode", 0, 0, std::uint64_t{1} << 53U);
  description.episode_steps = scenario.episode_steps;
  const auto transitions = whole_option(values, "transitions", 0, scenario.episode_steps, most_transitions);
  if (transitions % scenario.episode_steps != 0)
    throw UsageError(fmt::format("--transitions {}: an episode has {} steps, so a multiple of it is needed: {}",
                                 transitions, scenario.episode_steps,
                                 transitions - transitions % scenario.episode_steps));
  description.episodes = transitions / scenario.episode_steps;
  description.type = type_of(values);
  return description;
}

mpe::Collection collected(const mpe::Layout& layout, const mpe::Cast& cast, const mpe::DataDescription& description,
                          const std::string& folder, const mpe::CollectRules& rules, const Common& common) {
  const Interruption interruption;
  ProgressBar bar("collecting", !common.quiet);
  try {
    return mpe::collect(layout, cast, description, folder, rules, {std::ref(bar), Interruption::requested});
  } catch (const mpe::CollectionCancelled& cancelled) {
    throw EnvironmentError(
        fmt::format("interrupted with {} of {} episodes written; the same command with --resume goes on from there",
                    cancelled.written, description.episodes));
  }
}

int collect(const po::variables_map& values, const Common& common) {
  if (text_option(values, "output").empty()) throw UsageError("where to? Give --output DIR, the folder to make");
  const std::string folder = text_option(values, "output");
  const mpe::Layout layout(chosen_scenario(values));
  const mpe::Scenario& scenario = layout.scenario();
  auto description = description_of(values, scenario);
  mpe::CollectRules rules;
  rules.threads = threads_option(values, common);
  rules.resume = values.count("resume") != 0;
  const auto data = data_folder() / "mpe";
  mpe::Cast cast{controller(predators_of(values, description.seed), mpe::Side::predators, scenario, data),
                 controller(text_option(values, "prey"), mpe::Side::prey, scenario, data)};
  description.predators = cast.predators.name;
  description.prey = cast.prey.name;
  cast.predators = noisy(std::move(cast.predators), description.noise);

  const auto collection = collected(layout, cast, description, folder, rules, common);
  if (collection.end == mpe::Collection::End::was_there)
    common.note(fmt::format("{}: this very data set is there already", excerpt(folder, 1000)));
  else if (rules.resume)
    common.note(fmt::format("{} of {} episodes were there already", collection.kept, description.episodes));
  const auto report = data_report(folder, scenario, collection.record);
  if (common.format == Format::json)
    write_json(std::cout, report);
  else
    write_text(std::cout, report);
  return done;
}

}  // namespace

int mpe_collect(int argc, char** argv) { return run(argc, argv, collect_program(), {"text", "json"}, collect); }

}  // namespace folk::tools
