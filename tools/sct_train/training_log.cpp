#include <folk/tools/sct_train/training_log.h>

#include <folk/tools/sct_train/evaluation_csv.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace folk::tools {

TrainingLog::TrainingLog(std::filesystem::path file, const sct::TrainingRun& run, bool held_out)
    : file_(std::move(file)),
      held_out_(held_out) {
  write_file(file_, evaluation_table_so_far(run.history(), held_out_));
  descriptor_ = FileDescriptor(::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (descriptor_.get() < 0) fail(errno);
}

void TrainingLog::fail(int reason) const {
  throw EnvironmentError(fmt::format("--log {}: cannot be written: {}", excerpt(file_.string(), 1000),
                                     reason != 0 ? std::strerror(reason) : "the disk is full"));
}

/// A row is one call to the system, which a signal that kills does not cut: a part of one is the disk's doing, and
/// goes.
void TrainingLog::evaluation(const sct::TrainingRun& run) {
  const std::string row = evaluation_row(run.history().back(), run.kept() + 1 == run.history().size());
  struct stat before {};
  const bool known = ::fstat(descriptor_.get(), &before) == 0 && S_ISREG(before.st_mode);
  errno = 0;
  const auto written = ::write(descriptor_.get(), row.data(), row.size());
  if (written == static_cast<ssize_t>(row.size())) return;
  const int reason = written < 0 ? errno : 0;
  if (known && ::ftruncate(descriptor_.get(), before.st_size) != 0) fail(errno);
  fail(reason);
}

void TrainingLog::close(const sct::TrainingRun& run) {
  if (std::error_code ignored; std::filesystem::is_regular_file(file_, ignored))
    write_file(file_, evaluation_table(run.history(), run.kept(), held_out_));
}

}  // namespace folk::tools
