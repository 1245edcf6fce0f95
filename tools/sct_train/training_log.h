#pragma once
// The evaluations of a training run as a file that grows while it runs.

#include <folk/games/file_descriptor.h>
#include <folk/sct/training/training_run.h>

#include <filesystem>

namespace folk::tools {

/// A heading and a row an evaluation, each there as soon as the evaluation is: what stands in the file are whole rows,
/// however the run ends. While it lasts "kept" says whether the policy was kept when the row was made.
class TrainingLog {
public:
  /// Replaces the file by what the run has behind it, nothing or the evaluations of its checkpoint. Throws
  /// EnvironmentError.
  TrainingLog(std::filesystem::path file, const sct::TrainingRun& run, bool held_out);
  TrainingLog(const TrainingLog&) = delete;
  TrainingLog& operator=(const TrainingLog&) = delete;

  /// Adds the run's last evaluation. Throws EnvironmentError when it cannot be written whole; the rows before stay.
  void evaluation(const sct::TrainingRun& run);

  /// The run is over: marks the one policy that is kept. Throws EnvironmentError.
  void close(const sct::TrainingRun& run);

private:
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path file_;
  bool held_out_;
  FileDescriptor descriptor_;
};

}  // namespace folk::tools
