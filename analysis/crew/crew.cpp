#include <folk/analysis/crew/crew.h>
#include <folk/analysis/play/parallel.h>

#include <mutex>
#include <vector>

namespace folk {

void OneProcess::run(const SharedWork& work, const Progress& progress) const {
  if (store() == nullptr) {
    parallel_for(work.pieces, work.threads, work.work, progress);
    return;
  }
  store()->begin(work.identity(), work.pieces);
  std::vector<std::size_t> missing;
  for (std::size_t piece = 0; piece < work.pieces; ++piece) {
    if (const auto bytes = store()->find(piece)) {
      work.unpack(piece, *bytes);
    } else {
      missing.push_back(piece);
    }
  }
  std::mutex mutex;
  const double kept = static_cast<double>(work.pieces - missing.size());
  parallel_for(
      missing.size(), work.threads,
      [&](std::size_t i, unsigned worker) {
        work.work(missing[i], worker);
        const std::string bytes = work.pack(missing[i]);
        const std::lock_guard lock(mutex);
        store()->keep(missing[i], bytes);
      },
      progress.part(work.pieces > 0 ? kept / static_cast<double>(work.pieces) : 0, 1));
}

const Crew& one_process() {
  static const OneProcess crew;
  return crew;
}

}  // namespace folk
