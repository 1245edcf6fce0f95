#include <folk/analysis/play/parallel.h>
#include <folk/mpe/study/study.h>

#include <atomic>
#include <mutex>

namespace folk::mpe {

std::vector<StudyJob> missing_jobs(const std::vector<StudyJob>& jobs,
                                   const std::map<std::string, StudyRecord>& records) {
  std::vector<StudyJob> missing;
  for (const auto& job : jobs)
    if (!records.contains(job.name())) missing.push_back(job);
  return missing;
}

bool run_study(const std::vector<StudyJob>& jobs, const StudySettings& settings, StudyFolder& folder, unsigned threads,
               const StudyWatch& watch) {
  std::atomic<bool> failed = false;
  std::atomic<bool> whole = true;
  std::mutex mutex;
  const auto tell = [&](auto&& what, auto&&... arguments) {
    const std::scoped_lock lock(mutex);
    if (what) what(arguments...);
  };
  const auto stopped = [&] { return failed || (watch.interrupted && watch.interrupted()); };
  parallel_for(jobs.size(), threads, [&](std::size_t i, unsigned) {
    if (stopped()) {
      whole = false;
      return;
    }
    const auto& job = jobs[i];
    tell(watch.started, job);
    JobWatch rules;
    rules.interrupted = stopped;
    rules.progress = [&](double share) { tell(watch.progress, job, share); };
    rules.note = [&](const std::string& text) { tell(watch.note, text); };
    try {
      if (const auto record = run_job(job, settings, folder, rules))
        tell(watch.finished, job, *record);
      else
        whole = false;
    } catch (...) {
      failed = true;
      throw;
    }
  });
  return whole;
}

}  // namespace folk::mpe
