#pragma once
// Arrays as .npy files, the format of NumPy: one array of numbers with its shape.
//
// "\x93NUMPY", a version (1.0, 2.0 or 3.0), the header's length, the header "{'descr': '<f4', 'fortran_order': False,
// 'shape': (3, 4), }", then the numbers, the last index moving fastest; in Fortran order the first one. Sizes may have
// the L that Python 2 gave its whole numbers: (3L, 4L). Source of the format: NumPy's documentation of
// numpy.lib.format.

#include <folk/sct/files/npy_number.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace folk::sct {

std::string_view to_string(NpyType type);

/// An array of any of these types; truth values are 0 and 1.
struct NpyArray {
  std::vector<std::size_t> shape;  ///< no number in it: a single value
  std::vector<double> values;      ///< row-major; as many as the shape's product
};

/// No array that Folk reads has more numbers than this (1 GiB of doubles).
inline constexpr std::size_t most_npy_values = std::size_t{1} << 27U;

/// Reads a file's bytes, in either order; `source` (a path) is what messages call them. NaN and infinities are kept.
/// Throws InputFileError "source: what; mend" for what is no such file, another type, the other byte order, a size that
/// does not fit the shape, and whole numbers beyond 2^53, which a double does not hold.
NpyArray parse_npy(std::string_view bytes, const std::string& source);

/// parse_npy of a file's bytes. Also throws InputFileError when the file cannot be read.
NpyArray read_npy(const std::filesystem::path& path);

/// The bytes of a version 1.0 file, which parse_npy reads back to the same array (float32: rounded to the nearest).
/// Throws UsageError when the shape does not fit the values, or a value the type.
std::string npy_bytes(const NpyArray& array, NpyType type);

/// Writes npy_bytes at once or not at all (write_file of games/text_file.h). Throws UsageError, EnvironmentError.
void write_npy(const std::filesystem::path& path, const NpyArray& array, NpyType type);

/// What a file says before its numbers.
struct NpyHeader {
  NpyType type = NpyType::float64;
  std::vector<std::size_t> shape;
  std::size_t begin = 0;       ///< bytes before the first number; all that follow are numbers
  bool fortran_order = false;  ///< the first index moves fastest; false where there is only one
};

/// Reads it off a whole file's bytes, for those who read the numbers themselves. Throws what parse_npy throws, but for
/// the numbers, of which there may be up to `most`.
NpyHeader parse_npy_header(std::string_view bytes, const std::string& source, std::size_t most = most_npy_values);

/// The bytes before the numbers in a version 1.0 file: a multiple of 64. Throws UsageError when the shape has too many
/// dimensions.
std::string npy_header_bytes(const std::vector<std::size_t>& shape, NpyType type);

/// How many bytes a number of this type has.
std::size_t bytes_of(NpyType type);

/// The place of a value as its indices: "3, 17".
std::string npy_place(const std::vector<std::size_t>& shape, std::size_t value);
std::string npy_place(const NpyArray& array, std::size_t value);

}  // namespace folk::sct
