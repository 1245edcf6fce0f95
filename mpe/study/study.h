#pragma once
// The study: its jobs, one after the other on each thread, each kept as soon as it is done.

#include <folk/mpe/study/study_job.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace folk::mpe {

/// How a study is watched over; one thread at a time calls these. What they throw ends the study.
struct StudyWatch {
  Progress progress = nullptr;  ///< told the share of the jobs that are done, each counting the same
  std::function<void(const StudyJob&)> started = nullptr;
  std::function<void(const StudyJob&, double)> running = nullptr;  ///< the share of a running job that is done
  std::function<void(const StudyJob&, const StudyRecord&)> finished = nullptr;
  std::function<void(const std::string&)> note = nullptr;
};

/// The jobs of which there is no record.
std::vector<StudyJob> missing_jobs(const std::vector<StudyJob>& jobs,
                                   const std::map<std::string, StudyRecord>& records);

/// Does the jobs in their order, `threads` at once, each on one thread. Throws Cancelled: the same call goes on later.
/// When a job throws, the others are cancelled and it is thrown on.
void run_study(const std::vector<StudyJob>& jobs, const StudySettings& settings, StudyFolder& folder, unsigned threads,
               const StudyWatch& watch = {});

}  // namespace folk::mpe
