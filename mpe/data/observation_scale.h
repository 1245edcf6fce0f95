#pragma once
// Measures how far a data set's observations spread.

#include <folk/mpe/data/data_set.h>
#include <folk/mpe/network/observation_scale.h>

namespace folk::mpe {

/// Of each predator the mean and the standard deviation, with 1e-6 added, over all episodes, steps and numbers of its
/// observations together: the published program's. Summed in double, twice through the data; the result does not depend
/// on `threads`.
ObservationScale measured_scale(const DataSet& data, unsigned threads = 1);

}  // namespace folk::mpe
