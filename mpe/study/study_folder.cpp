#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/data/collect.h>
#include <folk/mpe/players/names.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/study/study_folder.h>
#include <folk/sct/files/checksum.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

namespace folk::mpe {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_record = std::size_t{4} << 20U;

/// Who played the predators of a data set.
std::string data_predators(const StudyJob& job) {
  if (job.level == "random") return fmt::format("untrained({})", data_seed);
  return job.data_prey == "maddpg" ? "expert_maddpg" : job.level;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw EnvironmentError(fmt::format("{}: cannot be made: {}", excerpt(folder.string(), 1000), error.message()));
}

}  // namespace

StudyFolder::StudyFolder(fs::path root, fs::path players, std::string folk_version)
    : root_(std::move(root)),
      players_(std::move(players)),
      folk_version_(std::move(folk_version)) {
  for (const char* part : {"records", "work/data", "work/runs", "work/policies", "work/lock"})
    make_folder(root_ / part);
  lock_ = std::make_unique<sct::CheckpointFiles>(root_ / "work" / "lock");
  for (const char* part : {"", "records", "work/policies", "latex", "pictures"}) remove_cut_off_writes(root_ / part);
  // A job that was cut off between its record and its end.
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator run(root_ / "work/runs", error), end; !error && run != end; run.increment(error))
    if (std::error_code ignored; fs::exists(root_ / "records" / (run->path().filename().string() + ".json"), ignored))
      left.push_back(run->path());
  for (const auto& run : left) fs::remove_all(run, error);
}

fs::path StudyFolder::record_file(const StudyJob& job) const { return root_ / "records" / (job.name() + ".json"); }

fs::path StudyFolder::policy_file(const StudyJob& job) const {
  return root_ / "work" / "policies" / (job.name() + ".safetensors");
}

fs::path StudyFolder::run_folder(const StudyJob& job) const { return root_ / "work" / "runs" / job.name(); }

std::shared_ptr<const DataSet> StudyFolder::data(const StudyJob& job, const StudySettings& settings,
                                                 const Progress& progress) {
  const std::scoped_lock lock(mutex_);
  const std::string name = job.data();
  if (auto there = open_[name].lock()) return there;
  const Layout layout(Scenario::named(job.scenario));
  const auto& scenario = layout.scenario();
  const Cast cast{controller(data_predators(job), Side::predators, scenario, players_),
                  controller(job.data_prey, Side::prey, scenario, players_)};
  DataDescription description;
  description.folk_version = folk_version_;
  description.scenario = scenario.name;
  description.level = job.level;
  description.predators = cast.predators.name;
  description.prey = cast.prey.name;
  description.seed = data_seed;
  description.episodes = settings.transitions / scenario.episode_steps;
  description.episode_steps = scenario.episode_steps;
  CollectRules rules;
  rules.resume = true;
  const fs::path folder = root_ / "work" / "data" / name;
  collect(layout, cast, description, folder, rules, progress);
  auto data = std::make_shared<const DataSet>(DataSet::open(folder));
  open_[name] = data;
  return data;
}

std::string study_identity(const std::string& scenario, const StudySettings& settings, const fs::path& players) {
  sct::Checksum sum;
  for (const std::uint64_t number : {settings.transitions, settings.episodes, settings.player_episodes,
                                     settings.selection_episodes, settings.intervention_episodes, report_batches})
    sum.add(number);
  for (const std::uint64_t seed : {data_seed, selection_seed, report_seed, intervention_seed}) sum.add(seed);
  for (const char* data_prey : {"released", "maddpg"})
    for (const double target : target_grid({data_prey, scenario, "expert", "sct", 1})) sum.add(target);
  for (const char* player : {"expert", "medium", "expert_maddpg", "released", "maddpg"})
    sum.add(read_file(players / fmt::format("{}_{}.safetensors", scenario, player), largest_policy_file));
  return fmt::format("{:016x}", sum.value());
}

std::map<std::string, StudyRecord> read_records(const fs::path& root, const StudySettings& settings,
                                                const fs::path& players) {
  std::map<std::string, StudyRecord> records;
  std::map<std::string, std::string> identities;
  for (const auto& job : study_jobs(settings)) {
    const fs::path file = root / "records" / (job.name() + ".json");
    std::error_code ignored;
    if (!fs::exists(file, ignored)) continue;
    auto record = parse_record(read_ordinary_file(file, largest_record), file.string());
    if (record.job != job)
      throw InputFileError(fmt::format("{}: the record of another job, {}; remove it, and its own is done again",
                                       excerpt(file.string(), 1000), excerpt(record.job.name())));
    if (record.budget != to_string(settings.budget))
      throw UsageError(fmt::format("{}: a study of budget {}, not {}; give --budget {} or another folder",
                                   excerpt(file.string(), 1000), excerpt(record.budget), to_string(settings.budget),
                                   excerpt(record.budget)));
    if (record.diverged.empty() &&
        !std::equal(record.preys.begin(), record.preys.end(), study_preys().begin(), study_preys().end(),
                    [](const PreyRecord& prey, const std::string& name) { return prey.prey == name; }))
      throw InputFileError(fmt::format("{}: not of the study's {} preys; remove it, and its job is done again",
                                       excerpt(file.string(), 1000), study_preys().size()));
    auto& identity = identities[job.scenario];
    if (identity.empty()) identity = study_identity(job.scenario, settings, players);
    if (record.identity != identity)
      throw UsageError(fmt::format(
          "{}: made with other players or other numbers of episodes than this Folk's; remove it, and its job "
          "is examined again, or name another folder",
          excerpt(file.string(), 1000)));
    records.emplace(job.name(), std::move(record));
  }
  return records;
}

}  // namespace folk::mpe
