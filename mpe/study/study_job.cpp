#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/data/data_figures.h>
#include <folk/mpe/offline/resumable_training.h>
#include <folk/mpe/players/any_policy.h>
#include <folk/mpe/players/names.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/study/study_job.h>
#include <folk/sct/files/checksum.h>
#include <folk/sct/files/safetensors.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

namespace folk::mpe {
namespace {

namespace fs = std::filesystem;

/// Of a job's time its training takes this share; the rest is its examination.
constexpr double training_share = 0.75;

Mean returns_of(std::span<const EpisodeScore> scores) { return mean_of(summarise(scores).predators); }

/// Means of successive parts of the episodes; none where there are fewer than parts.
std::vector<double> batches_of(std::span<const EpisodeScore> scores) {
  std::vector<double> means;
  for (std::size_t b = 0; scores.size() >= report_batches && b < report_batches; ++b) {
    const std::size_t begin = b * scores.size() / report_batches;
    const std::size_t end = (b + 1) * scores.size() / report_batches;
    means.push_back(returns_of(scores.subspan(begin, end - begin)).mean);
  }
  return means;
}

RightBeliefs right_beliefs(const BeliefSummary& summary) {
  RightBeliefs right;
  for (std::size_t r = 0; r < belief_radii.size(); ++r) right.right[r] = mean_of(summary.right[r]);
  for (std::size_t r = 0; r < absolute_radii.size(); ++r) right.within[r] = mean_of(summary.within[r]);
  right.distance = mean_of(summary.distance);
  return right;
}

/// The name of a player that learns nothing.
std::string spec_of(const StudyJob& job) {
  if (job.learner == "random_play") return "random";
  if (job.learner == "lead_pursuit") return "lead_pursuit";
  return job.data_prey == "maddpg" ? "expert_maddpg" : job.level;
}

/// Examines players and transformers against one prey after another.
class Examination {
public:
  Examination(const StudyJob& job, const StudySettings& settings, const StudyFolder& folder, const JobWatch& watch)
      : job_(job),
        settings_(settings),
        progress_(job.learns() ? watch.progress.part(training_share, 1) : watch.progress),
        layout_(Scenario::named(job.scenario)) {
    for (const auto& name : study_preys())
      preys_.push_back(controller(name, Side::prey, layout_.scenario(), folder.players()));
  }

  std::vector<PreyRecord> of(const Controller& predators) {
    std::vector<PreyRecord> records;
    for (std::size_t i = 0; i < preys_.size(); ++i) {
      PreyRecord record;
      record.prey = study_preys()[i];
      const auto scores = score_episodes(layout_, {predators, preys_[i]}, report_plan(), ticking());
      record.predators = returns_of(scores);
      record.batches = batches_of(scores);
      records.push_back(std::move(record));
      tell(i + 1);
    }
    return records;
  }

  std::vector<PreyRecord> of(const std::shared_ptr<const TransformerMind>& mind) {
    // What the return should be that is asked for, one may learn from the data's own prey without meeting another.
    const auto known = asked(mind, data_prey());
    const double data_target = best_target(known);
    std::vector<PreyRecord> records;
    for (std::size_t i = 0; i < preys_.size(); ++i) {
      records.push_back(of(mind, i, i == data_prey() ? known : asked(mind, i), data_target));
      tell(i + 1);
    }
    return records;
  }

private:
  EpisodePlan report_plan() const {
    return {report_seed + job_.seed, 0, job_.learns() ? settings_.episodes : settings_.player_episodes, 1};
  }

  std::size_t data_prey() const {
    const auto& names = study_preys();
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), job_.data_prey) - names.begin());
  }

  /// Ends the play where the job is cancelled; how far the job is, tell() says.
  Progress ticking() const {
    return {nullptr, [this] { return progress_.cancelled(); }};
  }

  void tell(std::size_t preys) const { progress_(static_cast<double>(preys) / static_cast<double>(preys_.size())); }

  TransformerScores report(const std::shared_ptr<const TransformerMind>& mind, std::size_t prey, double target) const {
    TransformerPlay how;
    how.target = target;
    return score_transformer(layout_, mind, preys_[prey], report_plan(), how, ticking());
  }

  std::vector<TargetScore> asked(const std::shared_ptr<const TransformerMind>& mind, std::size_t prey) const {
    return score_targets(layout_, mind, preys_[prey], {selection_seed + job_.seed, 0, settings_.selection_episodes, 1},
                         target_grid(job_), ticking());
  }

  PreyRecord of(const std::shared_ptr<const TransformerMind>& mind, std::size_t prey,
                const std::vector<TargetScore>& rows, double data_target) const {
    PreyRecord record;
    record.prey = study_preys()[prey];
    for (const auto& [target, predators, beliefs] : rows)
      record.asked.push_back(
          {target, mean_of(predators), beliefs ? std::optional<RightBeliefs>(right_beliefs(*beliefs)) : std::nullopt});
    record.target = best_target(rows);
    const auto scores = report(mind, prey, *record.target);
    record.predators = returns_of(scores.play);
    record.batches = batches_of(scores.play);
    if (mind->believes()) record.beliefs = right_beliefs(summarise(std::span<const EpisodeBeliefs>(scores.beliefs)));
    record.data_target = data_target;
    record.data_target_predators =
        data_target == *record.target ? record.predators : returns_of(report(mind, prey, data_target).play);
    record.own_target = mind->policy.return_target;
    record.own_target_predators = returns_of(report(mind, prey, *record.own_target).play);
    const auto& table = table_preys();
    if (!mind->acts_on_belief() || std::find(table.begin(), table.end(), record.prey) == table.end()) return record;
    TransformerPlay how;
    how.target = *record.target;
    for (const auto& forced :
         force_beliefs(layout_, mind, preys_[prey],
                       {intervention_seed + job_.seed, 0, settings_.intervention_episodes, 1}, how, ticking()))
      record.forced.push_back({std::string(to_string(forced.forcing)), mean_of(forced.predators),
                               mean_of(forced.difference), mean_of(forced.change)});
    return record;
  }

  const StudyJob& job_;
  const StudySettings& settings_;
  Progress progress_;
  Layout layout_;
  std::vector<Controller> preys_;
};

std::string signature_of(std::string_view bytes) {
  sct::Checksum sum;
  sum.add(bytes);
  return fmt::format("{:016x}", sum.value());
}

/// What an earlier run, cut off in its examination, has left; nothing where it is not this very training's end.
std::optional<std::string> earlier_policy(const fs::path& file, const std::map<std::string, std::string>& notes) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return std::nullopt;
  try {
    std::string bytes = read_file(file, largest_policy_file);
    const auto there = sct::parse_safetensors(bytes, file.string()).metadata;
    for (const auto& [key, text] : notes)
      if (const auto found = there.find(key); found == there.end() || found->second != text) return std::nullopt;
    return bytes;
  } catch (const InputFileError&) {
    return std::nullopt;  // damaged: it is made again
  }
}

/// The policy file of a job: that of an earlier run which was cut off after its training, or a new one.
std::string trained_policy(const StudyJob& job, const StudySettings& settings, StudyFolder& folder,
                           const JobWatch& watch, StudyRecord& record) {
  const auto data = folder.data(job, settings, {nullptr, [&] { return watch.progress.cancelled(); }});
  const auto choice = choice_of(job, settings);
  auto learner = make_learner(*data, choice);
  record.training = run_description(*data, choice, *learner);
  record.data_return = data_figures(*data).predator.mean;
  record.steps = learner_steps(*data, choice);
  const std::map<std::string, std::string> notes{{"training", record.training},
                                                 {"learner", job.learner},
                                                 {"budget", record.budget},
                                                 {"steps", fmt::to_string(record.steps)},
                                                 {"folk", record.folk}};
  if (auto bytes = earlier_policy(folder.policy_file(job), notes)) return *std::move(bytes);
  OfflineTraining training(std::move(learner), record.training, record.steps);
  {
    sct::CheckpointFiles checkpoints(folder.run_folder(job));
    TrainingWatch rules;
    rules.folder = &checkpoints;
    rules.checkpoint_every = std::max<std::uint64_t>(1, training.last_step() / 20);
    rules.note = watch.note;
    resume(training, rules);
    const double begun = static_cast<double>(training.steps()) / static_cast<double>(training.last_step());
    train(training, rules, watch.progress.part(training_share * begun, training_share));
  }
  std::string bytes = training.learner().policy(notes);
  write_file(folder.policy_file(job), bytes);
  return bytes;
}

/// Trains where the job does, and fills in what the preys say of it.
void examine(const StudyJob& job, const StudySettings& settings, StudyFolder& folder, const JobWatch& watch,
             StudyRecord& record) {
  Examination examination(job, settings, folder, watch);
  const Scenario scenario = Scenario::named(job.scenario);
  if (!job.learns()) {
    record.preys = examination.of(controller(spec_of(job), Side::predators, scenario, folder.players()));
    return;
  }
  const std::string bytes = trained_policy(job, settings, folder, watch, record);
  record.policy = signature_of(bytes);
  const std::string source = folder.policy_file(job).string();
  if (job.transformer())
    record.preys = examination.of(std::make_shared<const TransformerMind>(parse_transformer_policy(bytes, source)));
  else
    record.preys = examination.of(any_policy_controller(job.learner, bytes, source, Side::predators, scenario));
}

}  // namespace

StudyRecord run_job(const StudyJob& job, const StudySettings& settings, StudyFolder& folder, const JobWatch& watch) {
  StudyRecord record;
  record.job = job;
  record.budget = to_string(settings.budget);
  record.identity = study_identity(job.scenario, settings, folder.players());
  record.folk = folder.folk_version();
  record.episodes = job.learns() ? settings.episodes : settings.player_episodes;
  try {
    examine(job, settings, folder, watch, record);
  } catch (const TrainingDiverged& error) {  // for ever, as the same training does the same again
    record.diverged = error.what();
    record.preys.clear();
  }
  write_file(folder.record_file(job), record_text(record));
  std::error_code ignored;
  fs::remove_all(folder.run_folder(job), ignored);
  return record;
}

double job_cost(const StudyJob& job, const StudySettings& settings) {
  if (!job.learns()) return 5;
  if (settings.budget == Budget::smoke) return 5;
  const bool paper = settings.budget == Budget::paper;
  if (job.learner == "omar") return job.scenario == "simple_tag" ? 160 : 90;
  if (job.learner == "bc") return paper ? 170 : 25;
  if (job.learner == "ma-bcq") return paper ? 100'000 : 260;
  const double transformer = !paper ? 430 : job.level == "random" ? 34'000 : 3'700;
  return job.learner == "sct-selfconf" ? 2 * transformer : transformer;
}

}  // namespace folk::mpe
