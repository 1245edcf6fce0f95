#include <folk/tools/sct_train/begun_run.h>

#include <folk/tools/choices/standard_names.h>
#include <folk/tools/sct_train/data.h>
#include <folk/tools/sct_train/held_out.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

/// All that the end of the run depends on, a line each.
std::string description(const TrainConfig& config, const sct::TrainingSettings& settings, std::uint64_t data) {
  std::string text = fmt::format("folk = {}\n", FOLK_VERSION);
  // At their usual values these are left out: a checkpoint from before there were such keys is still of the same run.
  const std::set<std::string> newer{"held-out",        "game",       "opponents", "opponent-slip", "explore-every",
                                    "explore-matches", "remembered", "time-rows", "return-token",  "plan-depth"};
  std::map<std::string, std::string> usual;
  for (const auto& [key, value] : key_values(TrainConfig{})) usual[key] = value;
  for (const auto& [key, value] : key_values(config))
    if (key == "decay")
      text += fmt::format("decay = {}\n", settings.optimiser.decay_steps);
    else if (newer.contains(key) && value == usual[key])
      continue;
    else if (key == "game")
      text += fmt::format("actions = {}, {}\n", config.actions[0], config.actions[1]);  // wherever the file lies
    else if (key != "steps" && key != "patience" && key != "checkpoint-every")          // a run may be made longer
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
  record.roster = config.explores() ? config.met() : config.roster;
  record.payoffs = config.payoffs;
  record.rounds = config.rounds;
  record.criterion = Criterion::finite(config.rounds).to_string();
  record.return_scale = settings.windows.return_scale;
  record.shows_return = settings.windows.shows_return;
  record.plan_depth = static_cast<unsigned>(config.plan_depth);
  record.seed = settings.seed;
  record.code_version = FOLK_VERSION;
  return record;
}

/// Whom the evaluations play beside the roster; says so when nobody can tell whether training meets them.
std::vector<Strategy> held_out(const TrainConfig& config, const std::vector<Strategy>& roster, const TrainData& data,
                               const Common& common) {
  const auto names = standard_names();
  auto held = held_out_roster(config, met_in_training(config, roster, data.opponents, names), names);
  if (!held.empty() && data.opponents.contains(""))
    common.note(fmt::format("note: {} does not name its opponents: whether some of them are held out is not checked",
                            excerpt(config.data, 1000)));
  return held;
}

}  // namespace

BegunRun begin_run(TrainConfig& config, unsigned threads, const Common& common) {
  const auto roster = standard_names().roster(config.roster, config.payoffs);
  auto data = train_data(config, roster);
  const auto training = training_settings(config, threads);
  auto plan = run_settings(config, threads);
  plan.description = description(config, training, signature_of(data.lessons));
  plan.held_out = held_out(config, roster, data, common);
  const std::size_t lessons = data.lessons.size();
  return {roster, plan, training, lessons,
          sct::TrainingRun(plan, training, std::move(data.lessons), roster, record_of(config, training), data.teacher,
                           data.exploration)};
}

sct::Policy finished_policy(const BegunRun& begun, const TrainConfig& config) {
  auto policy = begun.run.policy();
  policy.action_names = {config.actions.begin(), config.actions.end()};
  return policy;
}

}  // namespace folk::tools
