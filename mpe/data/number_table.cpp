#include <folk/games/error.h>
#include <folk/mpe/data/number_table.h>
#include <folk/sct/files/little_endian.h>
#include <folk/sct/files/npy_number.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>

namespace folk::mpe {
namespace {

using sct::NpyType;
using sct::with_type;

template <class Number>
Number number_at(const char* bytes) {
  return std::bit_cast<Number>(sct::load_little_endian<sct::WordOf<Number>>({bytes, sizeof(Number)}));
}

/// Whether a float is near it; of no use is what rounds to infinity.
template <class Number>
bool fit(Number number) {
  if constexpr (std::floating_point<Number>)
    return std::abs(number) <= static_cast<Number>(std::numeric_limits<float>::max());
  else
    return true;
}

}  // namespace

NumberTable::NumberTable(std::string_view bytes, const std::string& source) {
  auto header = sct::parse_npy_header(bytes, source, std::numeric_limits<std::size_t>::max());
  // Rows are read where they lie, and there lies none.
  if (header.fortran_order) refuse_file(source, "in Fortran order; store numpy.ascontiguousarray of it");
  shape_ = std::move(header.shape);
  type_ = header.type;
  numbers_ = bytes.substr(header.begin);
  if (shape_.empty() || shape_.size() > 2)
    throw InputFileError(fmt::format("{}: shape ({}): expected (rows,) or (rows, columns)", excerpt(source, 1000),
                                     fmt::join(shape_, ", ")));
  rows_ = shape_[0];
  width_ = shape_.size() == 2 ? shape_[1] : 1;
}

float NumberTable::at(std::size_t row, std::size_t column) const {
  return with_type(type_, [&](auto zero) {
    using Number = decltype(zero);
    return static_cast<float>(number_at<Number>(numbers_.data() + (row * width_ + column) * sizeof(Number)));
  });
}

double NumberTable::exact(std::size_t number) const {
  return with_type(type_, [&](auto zero) {
    using Number = decltype(zero);
    return static_cast<double>(number_at<Number>(numbers_.data() + number * sizeof(Number)));
  });
}

void NumberTable::row(std::size_t row, std::span<float> numbers) const {
  with_type(type_, [&](auto zero) {
    using Number = decltype(zero);
    const char* from = numbers_.data() + row * width_ * sizeof(Number);
    if constexpr (std::same_as<Number, float> && std::endian::native == std::endian::little)
      std::memcpy(numbers.data(), from, width_ * sizeof(float));  // nothing to round, and windows ask for many rows
    else
      for (std::size_t column = 0; column < width_; ++column)
        numbers[column] = static_cast<float>(number_at<Number>(from + column * sizeof(Number)));
  });
}

std::string_view NumberTable::bytes(std::size_t begin, std::size_t end) const {
  const std::size_t row_bytes = width_ * bytes_of(type_);
  return numbers_.substr(begin * row_bytes, (end - begin) * row_bytes);
}

std::optional<std::size_t> NumberTable::find_unfit(std::size_t begin, std::size_t end) const {
  return with_type(type_, [&](auto zero) -> std::optional<std::size_t> {
    using Number = decltype(zero);
    const auto fit_at = [&](std::size_t i) { return fit(number_at<Number>(numbers_.data() + i * sizeof(Number))); };
    bool all = true;
    for (std::size_t i = begin * width_; i < end * width_; ++i) all &= fit_at(i);  // without a branch: many at once
    if (all) return std::nullopt;
    std::size_t first = begin * width_;
    while (fit_at(first)) ++first;
    return first;
  });
}

bool NumberTable::same_row(std::size_t a, const NumberTable& other, std::size_t b) const {
  if (type_ == other.type_ && bytes(a, a + 1) == other.bytes(b, b + 1)) return true;
  for (std::size_t column = 0; column < width_; ++column)
    if (at(a, column) != other.at(b, column)) return false;
  return true;
}

}  // namespace folk::mpe
