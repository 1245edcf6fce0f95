#pragma once
// The container of a policy file: the safetensors format, tensors and texts by name.
//
// 8 bytes N (little endian), N bytes of JSON, then the tensors' bytes:
//   {"__metadata__": {"key": "text"}, "name": {"dtype": "F32", "shape": [2, 3], "data_offsets": [0, 24]}}
// Offsets count from the end of the JSON; the tensors fill the rest of the file without gap or overlap.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace folk::sct {

/// No JSON header that Folk reads or writes is longer than this: three times what 256 layers need.
inline constexpr std::size_t longest_safetensors_header = std::size_t{1} << 20U;

/// A tensor as a file tells of it. Which type it has and whether the type and shape ask for so many bytes is the
/// reader's to check.
struct StoredTensor {
  std::string dtype;                 ///< "F32", "BF16", ...
  std::vector<std::uint64_t> shape;  ///< at most 8 numbers
  std::string_view data;             ///< in the bytes that were parsed
};

/// What a file holds, by name.
struct SafetensorsFile {
  std::map<std::string, std::string> metadata;
  std::map<std::string, StoredTensor> tensors;
};

/// Reads a file's bytes, which must outlive the result; `source` (a path) is what messages call them.
/// Throws InputFileError "source: what; mend" when they are too short, too long, no JSON of this form, name a thing
/// twice, or when the tensors do not fill the data exactly.
SafetensorsFile parse_safetensors(std::string_view bytes, const std::string& source);

/// A tensor to be written: F32.
struct TensorToStore {
  std::string name;
  std::vector<std::size_t> shape;
  std::size_t bytes = 0;
};

/// The length and the JSON header of a file, the tensors' bytes following each other in the order given; padded with
/// blanks so that they begin at a multiple of 8. The metadata must be UTF-8. Throws UsageError when the header gets
/// longer than longest_safetensors_header.
std::string safetensors_header(const std::map<std::string, std::string>& metadata,
                               const std::vector<TensorToStore>& tensors);

}  // namespace folk::sct
