#pragma once
// Several seeds of one training run, and what their files are called.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace folk::tools {

/// "1..5", "1,4,9" or both, "1..3,8": in this order. Throws UsageError that names --seeds.
std::vector<std::uint64_t> parse_seeds(const std::string& text);

/// A run's file where several are written: sct.bin is sct-3.bin for seed 3. A device or a pipe stays what it is.
std::filesystem::path of_seed(const std::filesystem::path& file, std::uint64_t seed);

}  // namespace folk::tools
