#include <folk/mpe/offline/resumable_training.h>

#include <algorithm>

namespace folk::mpe {

bool resume(OfflineTraining& training, const TrainingWatch& watch) {
  if (watch.folder == nullptr) return false;
  return watch.folder->read_newest(
      [&](std::string_view bytes, const std::string& source) { training.restore(bytes, source); },
      [&](const std::string& fault) {
        if (watch.note) watch.note(fault);
      });
}

void train(OfflineTraining& training, const TrainingWatch& watch, const Progress& progress) {
  const std::uint64_t first = training.steps();
  std::uint64_t saved = first;
  const auto save = [&] {
    if (watch.folder != nullptr && saved != training.steps())
      watch.folder->write_bytes(training.steps(), training.checkpoint());
    saved = training.steps();
  };
  const double all = static_cast<double>(std::max<std::uint64_t>(1, training.last_step() - first));
  const auto save_if_ended_by = [&](const auto& question) {
    try {
      question();
    } catch (...) {
      save();
      throw;
    }
  };
  while (!training.finished()) {
    if (training.steps() - saved >= watch.checkpoint_every) save();
    save_if_ended_by([&] { progress.check(); });
    training.step();
    save_if_ended_by([&] { progress(static_cast<double>(training.steps() - first) / all); });
  }
  save();
}

}  // namespace folk::mpe
