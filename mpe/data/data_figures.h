#pragma once
// What is said of a data set's numbers: their signature and the returns.

#include <folk/games/progress.h>
#include <folk/mpe/data/data_description.h>
#include <folk/mpe/data/data_set.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace folk::mpe {

/// Signature of one episode: of its rows' bytes in each file, in the order of data_files. Whole little-endian words of
/// 8 bytes are added, then the bytes that are left.
std::uint64_t episode_signature(std::span<const std::string_view> rows);

/// The signature is that of all episode_signatures in their order. The result does not depend on `threads`. Throws
/// Cancelled.
DataFigures data_figures(const DataSet& data, unsigned threads = 1, const Progress& progress = nullptr);

/// Throws InputFileError when the data set has a record whose signature is not that of its numbers.
void require_recorded(const DataSet& data, const DataFigures& figures);

}  // namespace folk::mpe
