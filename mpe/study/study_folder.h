#pragma once
// Where a study keeps what it has made.
//
//   records/JOB.json       what came of each finished job: enough to make all tables, and to go on anywhere
//   work/data/DATA/        data sets, collected when a job needs them
//   work/runs/JOB/         checkpoints of jobs that are running
//   work/policies/JOB.safetensors

#include <folk/games/progress.h>
#include <folk/mpe/data/data_set.h>
#include <folk/mpe/study/study_plan.h>
#include <folk/mpe/study/study_record.h>
#include <folk/sct/files/checkpoint_files.h>

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace folk::mpe {

/// Holds the folder's lock for as long as it lives.
class StudyFolder {
public:
  /// Makes the folder if need be. `players`: the folder of the shipped policies;
  /// `folk_version` is noted in data sets and policies. Throws EnvironmentError when it cannot
  /// be made or written, or another process works in it.
  StudyFolder(std::filesystem::path root, std::filesystem::path players, std::string folk_version);

  const std::filesystem::path& root() const { return root_; }
  const std::filesystem::path& players() const { return players_; }
  const std::string& folk_version() const { return folk_version_; }
  std::filesystem::path record_file(const StudyJob& job) const;
  std::filesystem::path policy_file(const StudyJob& job) const;
  std::filesystem::path run_folder(const StudyJob& job) const;

  /// The data set of a job, collected if it is not there. Throws Cancelled. Threads may ask at once.
  std::shared_ptr<const DataSet> data(const StudyJob& job, const StudySettings& settings,
                                      const Progress& progress = nullptr);

private:
  std::filesystem::path root_;
  std::filesystem::path players_;
  std::string folk_version_;
  std::unique_ptr<sct::CheckpointFiles> lock_;
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<const DataSet>> open_;
};

/// 16 hexadecimal digits over all that a scenario's records depend on beside job and learner: numbers of episodes and
/// transitions, targets, and the shipped players, which `players` is the folder of.
std::string study_identity(const std::string& scenario, const StudySettings& settings,
                           const std::filesystem::path& players);

/// The records of a folder by their jobs' names. Throws UsageError when one is of another budget or identity,
/// InputFileError when it is damaged or another job's. A folder that is not there has none.
std::map<std::string, StudyRecord> read_records(const std::filesystem::path& root, const StudySettings& settings,
                                                const std::filesystem::path& players);

}  // namespace folk::mpe
