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

void run_study(const std::vector<StudyJob>& jobs, const StudySettings& settings, StudyFolder& folder, unsigned threads,
               const StudyWatch& watch) {
  std::atomic<bool> failed = false;
  std::atomic<bool> cancelled = false;
  std::mutex mutex;
  const auto tell = [&](auto&& what, auto&&... arguments) {
    const std::scoped_lock lock(mutex);
    if (what) what(arguments...);
  };
  const auto stopped = [&] { return failed || cancelled || watch.progress.cancelled(); };
  std::size_t done = 0;
  parallel_for(jobs.size(), threads, [&](std::size_t i, unsigned) {
    const auto& job = jobs[i];
    JobWatch rules;
    rules.progress = {[&](double share) { tell(watch.running, job, share); }, stopped};
    rules.note = [&](const std::string& text) { tell(watch.note, text); };
    try {
      rules.progress.check();
      tell(watch.started, job);
      const auto record = run_job(job, settings, folder, rules);
      tell(watch.finished, job, record);
      const std::scoped_lock lock(mutex);
      watch.progress(static_cast<double>(++done) / static_cast<double>(jobs.size()));
    } catch (const Cancelled&) {
      cancelled = true;  // not thrown on from here: a job that failed has more to say
    } catch (...) {
      failed = true;
      throw;
    }
  });
  if (cancelled) throw Cancelled();
}

}  // namespace folk::mpe
