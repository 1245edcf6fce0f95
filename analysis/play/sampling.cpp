#include <folk/analysis/play/sampling.h>
#include <folk/games/error.h>

namespace folk {

Repetitions::Repetitions(std::uint64_t count)
    : count_(count) {
  if (count == 0) throw UsageError("repetitions: expected at least 1");
}

}  // namespace folk
