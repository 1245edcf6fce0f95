#pragma once
// The numbers of an .npy file as rows, read where they lie: nothing is copied until a row is asked for.

#include <folk/sct/files/npy_file.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

class NumberTable {
public:
  /// `bytes` are a whole file's and must outlive this; `source` (a path) is what messages call them. An array of shape
  /// [N] is a table of one column. Throws InputFileError for what parse_npy_header refuses, Fortran order and
  /// other shapes.
  NumberTable(std::string_view bytes, const std::string& source);

  std::size_t rows() const { return rows_; }
  std::size_t width() const { return width_; }
  const std::vector<std::size_t>& shape() const { return shape_; }
  sct::NpyType type() const { return type_; }
  bool holds_reals() const { return type_ == sct::NpyType::float32 || type_ == sct::NpyType::float64; }

  float at(std::size_t row, std::size_t column = 0) const;

  /// Writes a row's numbers, rounded to float; `numbers` has width() places.
  void row(std::size_t row, std::span<float> numbers) const;

  /// The bytes of rows [begin, end) as they stand in the file.
  std::string_view bytes(std::size_t begin, std::size_t end) const;

  /// A number counted from the table's beginning, as the file has it.
  double exact(std::size_t number) const;

  /// The first number of rows [begin, end) that no finite float is near; counted from the table's beginning.
  std::optional<std::size_t> find_unfit(std::size_t begin, std::size_t end) const;

  /// True when row `a` of this table and row `b` of another are the same floats.
  bool same_row(std::size_t a, const NumberTable& other, std::size_t b) const;

private:
  std::string_view numbers_;
  std::vector<std::size_t> shape_;
  sct::NpyType type_ = sct::NpyType::float32;
  std::size_t rows_ = 0;
  std::size_t width_ = 1;
};

}  // namespace folk::mpe
