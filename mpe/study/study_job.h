#pragma once
// A job of the study, from its data to its record.

#include <folk/games/progress.h>
#include <folk/mpe/study/study_folder.h>
#include <folk/mpe/study/study_plan.h>
#include <folk/mpe/study/study_record.h>

#include <functional>
#include <string>

namespace folk::mpe {

/// How a job is watched over; it may be asked and told from a thread of its own.
struct JobWatch {
  Progress progress = nullptr;                             ///< told the share of the job that is done
  std::function<void(const std::string&)> note = nullptr;  ///< told of checkpoints that could not be read
};

/// Trains what the job trains (going on from its last checkpoint), examines it against every prey of the study and
/// writes the record; its checkpoints are then removed. What comes out depends on the job and the settings alone. A
/// training that diverges has a record that says so.
/// Throws Cancelled and what the progress throws: the same call goes on from there; EnvironmentError when something
/// cannot be written.
StudyRecord run_job(const StudyJob& job, const StudySettings& settings, StudyFolder& folder,
                    const JobWatch& watch = {});

/// About how many seconds a job takes on one core.
double job_cost(const StudyJob& job, const StudySettings& settings);

}  // namespace folk::mpe
