#pragma once
// What a transformer learns from: stretches of a data set's episodes.

#include <folk/mpe/data/data_set.h>
#include <folk/mpe/network/observation_scale.h>
#include <folk/sct/network/batch.h>

#include <cstddef>
#include <cstdint>

namespace folk::mpe {

/// Windows as the published program draws them: an episode and a first step, both uniform, then `context` steps (fewer
/// where episodes are shorter). The return tokens hold what predator 0 goes on to earn, undiscounted, divided by
/// `return_scale`; observations are on the scale. Depends on the seed and the step alone.
sct::Batch<float> draw_windows(const DataSet& data, const ObservationScale& scale, double return_scale,
                               std::size_t windows, std::size_t context, std::uint64_t seed, std::uint64_t step);

}  // namespace folk::mpe
