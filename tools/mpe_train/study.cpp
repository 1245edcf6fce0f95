#include <folk/tools/mpe_train/study.h>

#include <folk/tools/mpe_train/study_output.h>
#include <folk/tools/program/data_folder.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/table.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/mpe/players/names.h>
#include <folk/mpe/study/study.h>
#include <folk/mpe/study/study_tables.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <system_error>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using mpe::StudyJob;
using mpe::StudyRecord;
using mpe::StudySettings;

constexpr const char* study_name = "mpe-train study";

Program study_program() {
  Program program;
  program.name = study_name;
  program.title = "the paper's comparison of offline learners, from data to tables";
  program.usage = "--output DIR [options]";
  program.summary =
      "The comparison of offline learners of the paper (arXiv 2310.04579) on the particle world: collects the data,\n"
      "trains omar, bc, ma-bcq, madt, rmadt and sct on each level of both scenarios, examines them against five "
      "preys,\n"
      "and writes all tables (text, CSV, LaTeX), pictures and a page. What is done is not done again: the same "
      "command\n"
      "goes on after any interruption, and anywhere, as DIR/records holds all that the tables are made of.";
  program.examples = {
      "mpe-train study --output study", "mpe-train study --output study --status",
      "mpe-train study --output study --only sct,madt,simple_tag,expert",
      "mpe-train study --output study-paper --budget paper --only sct,rmadt,madt,simple_tag,expert,seed1",
      "mpe-train study --output smoke --budget smoke"};
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("output", text(), "the study's folder, made if need be");
  add("budget", text(), "smoke (a minute, says nothing), small (hours, the default) or paper (weeks)");
  add("seeds", text(), "training seeds of each learner (default 3; data of level random have one)");
  add("only", text(),
      "words that choose jobs: learners, scenarios, levels, data's preys (released, maddpg), seed1, ...");
  add("threads", text(), "jobs at a time (default: one a processor); the results do not depend on it");
  add("status", "only say what is done, what is begun and what is left");
  add("tables", "only make the tables of what is done");
  return program;
}

/// What is told on stderr while the study runs: a line for each job that begins or is done, and on a terminal a bar.
class Teller {
public:
  Teller(std::size_t all, std::size_t done, std::vector<StudyJob> left, const StudySettings& settings, unsigned threads,
         bool enabled)
      : all_(all),
        done_(done),
        threads_(threads),
        enabled_(enabled),
        bar_("study", enabled) {
    for (const auto& job : left) left_[job.name()] = mpe::job_cost(job, settings);
    for (const auto& [unused, cost] : left_) cost_ += cost;
  }

  void started(const StudyJob& job) {
    running_[job.name()] = {Clock::now(), 0};
    line(fmt::format("{}: begun", job.name()));
  }

  void progress(const StudyJob& job, double share) {
    running_[job.name()].share = share;
    double done = cost_done_;
    for (const auto& [one, running] : running_) done += left_[one] * running.share;
    bar_(done / cost_);
  }

  void finished(const StudyJob& job, const StudyRecord& record) {
    const double seconds = std::chrono::duration<double>(Clock::now() - running_[job.name()].begun).count();
    running_.erase(job.name());
    cost_done_ += left_[job.name()];
    seconds_done_ += seconds;
    left_.erase(job.name());
    ++done_;
    const double remaining = seconds_done_ / cost_done_ * (cost_ - cost_done_) / threads_;
    std::string returns;
    for (const auto& prey : record.preys)
      if (prey.prey == job.data_prey)
        returns =
            fmt::format(", return {:.1f} ± {:.1f} against {}", prey.predators.mean, prey.predators.ci95, prey.prey);
    line(fmt::format("{}: done in {}{}; {} of {} done, {} running, about {} left", job.name(), duration(seconds),
                     returns, done_, all_, running_.size(), duration(remaining)));
  }

  void line(const std::string& text) {
    if (!enabled_) return;
    bar_.make_way();
    say(study_name, text);
  }

private:
  struct Running {
    Clock::time_point begun;
    double share = 0;
  };

  std::size_t all_;
  std::size_t done_;
  unsigned threads_;
  bool enabled_;
  ProgressBar bar_;
  std::map<std::string, double> left_;  // what each job costs
  std::map<std::string, Running> running_;
  double cost_ = 0;
  double cost_done_ = 0;
  double seconds_done_ = 0;
};

/// Every job and how it stands.
void write_status(std::ostream& out, const std::vector<StudyJob>& jobs,
                  const std::map<std::string, StudyRecord>& records, const fs::path& root) {
  Table table({"data's prey", "scenario", "level", "learner", "seed", "state"});
  std::size_t done = 0;
  for (const auto& job : jobs) {
    std::error_code ignored;
    const bool recorded = records.contains(job.name());
    done += recorded ? 1U : 0U;
    const bool begun = fs::exists(root / "work" / "runs" / job.name(), ignored);
    table.add({job.data_prey, job.scenario, job.level, job.learner, fmt::to_string(job.seed),
               recorded ? "done"
               : begun  ? "begun"
                        : "left"});
  }
  out << table.text() << fmt::format("\n{} of {} jobs done\n", done, jobs.size());
}

void work(const std::vector<StudyJob>& missing, std::size_t all, const StudySettings& settings,
          mpe::StudyFolder& folder, unsigned threads, const Common& common) {
  const Interruption interruption;
  Teller teller(all, all - missing.size(), missing, settings, threads, !common.quiet);
  mpe::StudyWatch watch;
  watch.progress = {nullptr, Interruption::requested};
  watch.started = [&](const StudyJob& job) { teller.started(job); };
  watch.running = [&](const StudyJob& job, double share) { teller.progress(job, share); };
  watch.finished = [&](const StudyJob& job, const StudyRecord& record) { teller.finished(job, record); };
  watch.note = [&](const std::string& text) { teller.line(fmt::format("note: {}; the one before is taken", text)); };
  try {
    mpe::run_study(missing, settings, folder, threads, watch);
  } catch (const Cancelled&) {
    throw EnvironmentError("interrupted; the same command goes on from there");
  }
}

int study(const po::variables_map& values, const Common& common) {
  const fs::path root = text_option(values, "output");
  if (root.empty()) throw UsageError("where to? Give --output DIR, the folder of the study");
  if (std::error_code ignored; fs::exists(root, ignored) && !fs::is_directory(root, ignored))
    throw EnvironmentError(fmt::format("--output {}: it is no folder; name another", excerpt(root.string(), 1000)));
  const auto budget = mpe::parse_budget(text_option(values, "budget", "small"));
  const auto settings = StudySettings::of(budget, whole_option(values, "seeds", 3, 1, 100));
  std::vector<std::string> only;
  if (values.count("only") != 0) {
    const std::string words = text_option(values, "only");
    if (words.find_first_not_of(", ") == std::string::npos)
      throw UsageError("--only: no word is given; name learners, scenarios, levels, ... or leave it out");
    only = mpe::split_names(words);
  }
  const auto jobs = mpe::study_jobs(settings, only);
  if (jobs.empty()) throw UsageError("--only: no job has all of these; see --status for those there are");
  const auto threads = threads_option(values, common);
  const fs::path players = data_folder() / "mpe";
  const auto paper = mpe::read_paper_tables(players);
  auto records = mpe::read_records(root, settings, players);
  if (values.count("status") != 0) {
    write_status(std::cout, jobs, records, root);
    return done;
  }
  if (values.count("tables") != 0 && records.empty())
    throw UsageError(fmt::format("--tables: {} has no records of a study; give the folder of one that was begun",
                                 excerpt(root.string(), 1000)));
  mpe::StudyFolder folder(root, players, FOLK_VERSION);
  if (values.count("tables") == 0) {
    const auto missing = mpe::missing_jobs(jobs, records);
    if (!missing.empty()) work(missing, jobs.size(), settings, folder, threads, common);
    records = mpe::read_records(root, settings, players);
  }
  const auto main = mpe::study_tables(records, settings, "released", paper);
  const auto second = mpe::study_tables(records, settings, "maddpg", paper);
  write_study_files(root, main, second, settings);
  std::cout << study_text(main, second);
  return done;
}

}  // namespace

int mpe_study(int argc, char** argv) { return run(argc, argv, study_program(), {}, study); }

}  // namespace folk::tools
