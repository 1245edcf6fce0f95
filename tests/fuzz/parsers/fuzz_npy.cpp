// parse_npy: whatever is read is written and read back as the same array.

#include <folk/sct/files/npy_file.h>

#include <bit>
#include <cstdint>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view bytes) {
    using namespace folk::sct;
    const NpyArray array = parse_npy(bytes, "fuzz.npy");
    const NpyArray back = parse_npy(npy_bytes(array, NpyType::float64), "fuzz.npy");
    folk::fuzz::require(back.shape == array.shape && back.values.size() == array.values.size());
    for (std::size_t i = 0; i < array.values.size(); ++i)  // by their bits: NaN is not equal to itself
      folk::fuzz::require(std::bit_cast<std::uint64_t>(back.values[i]) ==
                          std::bit_cast<std::uint64_t>(array.values[i]));
  });
}
