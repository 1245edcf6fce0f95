#pragma once
// Where training starts.

#include <folk/sct/network/architecture.h>

#include <cstdint>
#include <vector>

namespace folk::sct {

/// Blocks N(0, 0.02) with zero biases, normalisations 1 and 0, embeddings and heads uniform within 1/sqrt(inputs),
/// tables N(0, 1): as the published program starts.
std::vector<float> initial_parameters(const Architecture& architecture, std::uint64_t seed);

}  // namespace folk::sct
