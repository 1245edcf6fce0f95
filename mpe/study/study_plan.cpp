#include <folk/games/error.h>
#include <folk/mpe/study/study_plan.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

namespace folk::mpe {
namespace {

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A property of jobs.
using Property = std::string (*)(const StudyJob&);
constexpr std::array<Property, 5> properties{
    [](const StudyJob& job) { return job.data_prey; }, [](const StudyJob& job) { return job.scenario; },
    [](const StudyJob& job) { return job.level; }, [](const StudyJob& job) { return job.learner; },
    [](const StudyJob& job) { return fmt::format("seed{}", job.seed); }};

std::vector<StudyJob> all_jobs(const StudySettings& settings) {
  std::vector<StudyJob> jobs;
  for (const auto& scenario : study_scenarios()) {
    for (const char* player : {"lead_pursuit", "random_play"})
      jobs.push_back({"released", scenario, "none", player, 1});
    for (const char* level : {"expert", "medium"}) jobs.push_back({"released", scenario, level, "matd3", 1});
    for (const char* player : {"lead_pursuit", "random_play"}) jobs.push_back({"maddpg", scenario, "none", player, 1});
    jobs.push_back({"maddpg", scenario, "expert", "matd3", 1});
  }
  const auto learn = [&](const char* data_prey, const char* level, std::uint64_t seed, bool transformers) {
    for (const auto& scenario : study_scenarios())
      for (const auto& learner : study_learners()) {
        const StudyJob job{data_prey, scenario, level, learner, seed};
        const bool extra = learner == "sct-selfconf" && (job.data_prey != "released" || job.level != "expert");
        if (job.transformer() == transformers && !extra) jobs.push_back(job);
      }
  };
  // What says most comes first, so that an interrupted study has every table begun: one seed of everything, then the
  // transformers' other seeds.
  for (const bool transformers : {false, true}) {
    for (const char* level : {"expert", "medium", "random"}) learn("released", level, 1, transformers);
    learn("maddpg", "expert", 1, transformers);
  }
  for (const bool transformers : {true, false})
    for (std::uint64_t seed = 2; seed <= settings.seeds; ++seed) {
      for (const char* level : {"expert", "medium"}) learn("released", level, seed, transformers);
      learn("maddpg", "expert", seed, transformers);
    }
  return jobs;
}

}  // namespace

std::string StudyJob::name() const { return fmt::format("{}-{}-{}", data(), learner, seed); }

std::string StudyJob::data() const { return fmt::format("{}-{}-{}", data_prey, scenario, level); }

bool StudyJob::learns() const { return !contains(study_players(), learner); }

bool StudyJob::transformer() const {
  return learner == "madt" || learner == "rmadt" || learner == "sct" || learner == "sct-selfconf";
}

const std::vector<std::string>& study_scenarios() {
  static const std::vector<std::string> scenarios{"simple_tag", "simple_world"};
  return scenarios;
}

const std::vector<std::string>& study_learners() {
  static const std::vector<std::string> learners{"omar", "bc", "ma-bcq", "madt", "rmadt", "sct", "sct-selfconf"};
  return learners;
}

const std::vector<std::string>& study_players() {
  static const std::vector<std::string> players{"matd3", "lead_pursuit", "random_play"};
  return players;
}

const std::vector<std::string>& table_preys() {
  static const std::vector<std::string> preys{"released", "maddpg", "still", "random(program)", "blend(0.5)"};
  return preys;
}

const std::vector<BlendPrey>& blend_preys() {
  static const std::vector<BlendPrey> preys{
      {1, "released"}, {0.7, "blend(0.7)"}, {0.5, "blend(0.5)"}, {0.3, "blend(0.3)"}, {0, "random(program)"}};
  return preys;
}

const std::vector<std::string>& study_preys() {
  static const std::vector<std::string> preys = [] {
    auto all = table_preys();
    for (const auto& blend : blend_preys())
      if (!contains(all, blend.prey)) all.push_back(blend.prey);
    return all;
  }();
  return preys;
}

StudySettings StudySettings::of(Budget budget, std::uint64_t seeds) {
  StudySettings settings;
  settings.budget = budget;
  settings.seeds = seeds;
  if (budget == Budget::smoke) settings = {budget, 5'000, 64, 128, 16, 16, 1};
  return settings;
}

std::vector<double> target_grid(const StudyJob& job) {
  const double step = job.data_prey == "maddpg" ? 20 : job.scenario == "simple_tag" ? 80 : 40;
  std::vector<double> targets;
  for (int i = 0; i < 7; ++i) targets.push_back(step * i);
  return targets;
}

std::vector<StudyJob> study_jobs(const StudySettings& settings, const std::vector<std::string>& only) {
  const auto all = all_jobs(settings);
  std::array<std::set<std::string>, properties.size()> wanted;
  for (const auto& word : only) {
    bool known = false;
    for (std::size_t p = 0; p < properties.size(); ++p)
      if (std::any_of(all.begin(), all.end(), [&](const StudyJob& job) { return properties[p](job) == word; })) {
        wanted[p].insert(word);
        known = true;
      }
    if (known) continue;
    std::set<std::string> words;
    for (const auto& job : all)
      for (const auto property : properties) words.insert(property(job));
    throw UsageError(
        fmt::format("'{}': no job of the study has this; expected of {}", excerpt(word), fmt::join(words, ", ")));
  }
  std::vector<StudyJob> jobs;
  for (const auto& job : all) {
    bool chosen = true;
    for (std::size_t p = 0; p < properties.size(); ++p)
      chosen = chosen && (wanted[p].empty() || wanted[p].contains(properties[p](job)));
    if (chosen) jobs.push_back(job);
  }
  return jobs;
}

LearnerChoice choice_of(const StudyJob& job, const StudySettings& settings) {
  LearnerChoice choice;
  const bool selfconf = job.learner == "sct-selfconf";
  choice.kind = parse_learner(selfconf ? "sct" : job.learner);
  choice.budget = settings.budget;
  choice.seed = job.seed;
  choice.level = job.level;
  if (selfconf) choice.loss = sct::LossMode::selfconf;
  return choice;
}

}  // namespace folk::mpe
