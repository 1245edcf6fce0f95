#pragma once
// An online training run as bytes, to go on with later, elsewhere, on any number of threads, to the same end.
//
// The memory of transitions is kept as the actions alone: places and everything else follow from the seed, because the
// world is exact.

#include <folk/mpe/online/training.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace folk::mpe {

/// All that the end of a run depends on, one "key = value" a line; a run may be made longer, which is no other run
/// while rates stay constant.
std::string description(const OnlineTraining& training, std::string_view prey);

/// The run as it stands. Throws UsageError when a number is not finite: training has diverged.
std::string online_checkpoint(const OnlineTraining& training, const std::string& description);

/// Goes on from there; `source` (a path) is what messages call the bytes. Nothing in them is taken on trust. Throws
/// InputFileError "source: what; mend" when they are damaged, and UsageError, naming what differs, when they are of
/// another run or of a later episode than this run's last. On a throw the training is as it was.
void restore(OnlineTraining& training, std::string_view bytes, const std::string& source,
             const std::string& description);

}  // namespace folk::mpe
