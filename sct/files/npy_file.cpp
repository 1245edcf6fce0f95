#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/sct/files/little_endian.h>
#include <folk/sct/files/npy_file.h>
#include <folk/sct/files/npy_number.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace folk::sct {

namespace {

constexpr std::string_view magic("\x93NUMPY", 6);
constexpr std::size_t most_dimensions = 8;
constexpr std::size_t longest_header = 65535;  // what version 1.0 can hold
constexpr std::size_t alignment = 64;          // of the first number
constexpr std::size_t largest_file = (most_npy_values * 8) + (std::size_t{1} << 20U);
constexpr std::size_t largest_count = std::numeric_limits<std::size_t>::max() / 8;  // in bytes still a size_t
constexpr double largest_whole = 9007199254740992.0;                                // 2^53

constexpr std::array all_types = {NpyType::float32, NpyType::float64, NpyType::int32,  NpyType::int64,
                                  NpyType::int8,    NpyType::uint8,   NpyType::boolean};

/// What the header's dictionary says.
struct Dictionary {
  std::optional<std::string> type;
  std::optional<bool> fortran_order;
  std::optional<std::vector<std::size_t>> shape;
};

/// Reads the dictionary: a literal of Python with three keys in any order.
class DictionaryReader {
public:
  DictionaryReader(std::string_view text, const std::string& source)
      : rest_(text),
        source_(source) {}

  Dictionary read() {
    expect('{');
    while (!take('}')) {
      const std::string key = text();
      expect(':');
      read_value(key);
      if (!take(',') && !next_is('}')) damaged("a comma or '}' is missing");
    }
    skip_blanks();
    if (!rest_.empty()) damaged("something follows its '}'");
    if (!found_.type || !found_.fortran_order || !found_.shape) damaged("it lacks descr, fortran_order or shape");
    return found_;
  }

private:
  [[noreturn]] void damaged(const std::string& what) const {
    refuse_file(source_, fmt::format("damaged header: {}; write the array again with numpy.save", what));
  }

  void skip_blanks() {
    while (!rest_.empty() && (rest_[0] == ' ' || rest_[0] == '\n' || rest_[0] == '\t')) rest_.remove_prefix(1);
  }

  bool next_is(char mark) {
    skip_blanks();
    return rest_.starts_with(mark);
  }

  bool take(char mark) {
    if (!next_is(mark)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void expect(char mark) {
    if (!take(mark)) damaged(fmt::format("'{}' is missing", mark));
  }

  std::string text() {
    skip_blanks();
    const char quote = rest_.empty() ? ' ' : rest_[0];
    if (quote != '\'' && quote != '"') damaged("a text is missing");
    const auto end = rest_.find(quote, 1);
    if (end == std::string_view::npos) damaged("a text does not end");
    std::string inside(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    return inside;
  }

  void read_value(const std::string& key) {
    if (key == "descr") {
      if (next_is('[')) refuse_file(source_, "an array of records; store one array of numbers a file");
      once(found_.type, key) = text();
    } else if (key == "fortran_order") {
      once(found_.fortran_order, key) = truth();
    } else if (key == "shape") {
      read_shape(once(found_.shape, key).emplace());
    } else {
      damaged(fmt::format("an unknown '{}'", excerpt(key)));
    }
  }

  template <class Value>
  std::optional<Value>& once(std::optional<Value>& value, const std::string& key) const {
    if (value) damaged(fmt::format("'{}' is there twice", key));
    return value;
  }

  bool truth() {
    skip_blanks();
    for (const bool value : {true, false}) {
      const std::string_view word = value ? "True" : "False";
      if (!rest_.starts_with(word)) continue;
      rest_.remove_prefix(word.size());
      return value;
    }
    damaged("fortran_order is neither True nor False");
  }

  /// (), (3,) or (3, 4): in a tuple of one the comma must be there.
  void read_shape(std::vector<std::size_t>& shape) {
    expect('(');
    bool comma = false;
    while (!take(')')) {
      if (!shape.empty() && !comma) damaged("a comma is missing in the shape");
      if (shape.size() == most_dimensions) damaged(fmt::format("more than {} dimensions", most_dimensions));
      skip_blanks();
      std::size_t size = 0;
      const auto [stop, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), size);
      if (error != std::errc()) damaged("a size that is no whole number in range");
      rest_.remove_prefix(static_cast<std::size_t>(stop - rest_.data()));
      if (rest_.starts_with('L')) rest_.remove_prefix(1);  // a whole number as Python 2 wrote it
      shape.push_back(size);
      comma = take(',');
    }
    if (shape.size() == 1 && !comma) damaged("a comma is missing in the shape");
  }

  std::string_view rest_;
  const std::string& source_;
  Dictionary found_;
};

/// The header's text; `bytes` loses all that stands before the numbers.
std::string_view take_header(std::string_view& bytes, const std::string& source) {
  if (bytes.empty()) refuse_file(source, "an empty file; write the array again with numpy.save");
  if (!bytes.starts_with(magic)) refuse_file(source, "no .npy file; write the array with numpy.save");
  const char* truncated = "ends within its header; take a fresh copy";
  if (bytes.size() < magic.size() + 2) refuse_file(source, truncated);
  const auto version = static_cast<unsigned char>(bytes[magic.size()]);
  if (version < 1 || version > 3 || bytes[magic.size() + 1] != 0)
    refuse_file(source,
                fmt::format("version {}.{} of the .npy format: expected 1.0, 2.0 or 3.0; write it with numpy.save",
                            version, static_cast<unsigned char>(bytes[magic.size() + 1])));
  bytes.remove_prefix(magic.size() + 2);
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  if (bytes.size() < length_bytes) refuse_file(source, truncated);
  const std::size_t length =
      version == 1 ? load_little_endian<std::uint16_t>(bytes) : load_little_endian<std::uint32_t>(bytes);
  bytes.remove_prefix(length_bytes);
  if (length > bytes.size()) refuse_file(source, truncated);
  if (length > longest_header)
    refuse_file(source, fmt::format("a header of {} bytes; store one array of numbers", length));
  const std::string_view header = bytes.substr(0, length);
  bytes.remove_prefix(length);
  return header;
}

NpyType type_of(const std::string& descr, const std::string& source) {
  for (const NpyType type : all_types)
    if (descr == to_string(type)) return type;
  refuse_file(source,
              fmt::format("numbers of type '{}': expected <f4, <f8, <i4, <i8, |i1, |u1 or |b1; convert with astype",
                          excerpt(descr)));
}

/// Where the number at `place` of a file in Fortran order, its first index moving fastest, stands row-major.
std::size_t row_major(const std::vector<std::size_t>& shape, std::size_t count, std::size_t place) {
  std::size_t found = 0;
  for (const std::size_t size : shape) {
    count /= size;
    found += place % size * count;
    place /= size;
  }
  return found;
}

/// The shape's product where it is no more than `most`; a shape with a 0 may have any other sizes.
std::optional<std::size_t> product(const std::vector<std::size_t>& shape, std::size_t most = most_npy_values) {
  std::size_t count = 1;
  for (const std::size_t size : shape)
    if (size == 0) return 0;
  for (const std::size_t size : shape) {
    if (size > most / count) return std::nullopt;
    count *= size;
  }
  return count;
}

}  // namespace

std::string_view to_string(NpyType type) {
  switch (type) {
    case NpyType::float32: return "<f4";
    case NpyType::float64: return "<f8";
    case NpyType::int32: return "<i4";
    case NpyType::int64: return "<i8";
    case NpyType::int8: return "|i1";
    case NpyType::uint8: return "|u1";
    case NpyType::boolean: return "|b1";
  }
  return "?";
}

std::size_t bytes_of(NpyType type) { return static_cast<std::size_t>(to_string(type)[2] - '0'); }

std::string npy_place(const std::vector<std::size_t>& shape, std::size_t value) {
  std::vector<std::size_t> indices(shape.size());
  for (std::size_t d = indices.size(); d-- > 0;) {
    indices[d] = value % shape[d];
    value /= shape[d];
  }
  return fmt::format("{}", fmt::join(indices, ", "));
}

std::string npy_place(const NpyArray& array, std::size_t value) { return npy_place(array.shape, value); }

NpyHeader parse_npy_header(std::string_view bytes, const std::string& source, std::size_t most) {
  std::string_view numbers = bytes;
  const Dictionary dictionary = DictionaryReader(take_header(numbers, source), source).read();
  const NpyHeader header{type_of(*dictionary.type, source), *dictionary.shape, bytes.size() - numbers.size(),
                         *dictionary.fortran_order && dictionary.shape->size() > 1};
  most = std::min(most, largest_count);
  const auto count = product(header.shape, most);
  if (!count) refuse_file(source, fmt::format("more than {} numbers; split the array into several files", most));
  const std::size_t asked = *count * bytes_of(header.type);
  if (numbers.size() != asked)
    refuse_file(source, fmt::format("{} bytes of numbers, but shape ({}) of {} asks for {}; take a fresh copy",
                                    numbers.size(), fmt::join(header.shape, ", "), to_string(header.type), asked));
  return header;
}

NpyArray parse_npy(std::string_view bytes, const std::string& source) {
  NpyHeader header = parse_npy_header(bytes, source);
  const NpyType type = header.type;
  bytes.remove_prefix(header.begin);
  NpyArray array{std::move(header.shape), {}};
  const std::size_t count = bytes.size() / bytes_of(type);
  array.values.resize(count);
  with_type(type, [&](auto zero) {
    using Number = decltype(zero);
    using Word = WordOf<Number>;
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = std::bit_cast<Number>(load_little_endian<Word>(bytes.substr(i * sizeof(Word))));
      const auto value = static_cast<double>(number);
      const std::size_t place = header.fortran_order ? row_major(array.shape, count, i) : i;
      const bool wrong =
          type == NpyType::boolean ? number > 1 : type == NpyType::int64 && std::abs(value) >= largest_whole;
      if (wrong)
        refuse_file(source, fmt::format("{} at [{}]: expected {}", number, npy_place(array, place),
                                        type == NpyType::boolean ? "a truth value, 0 or 1" : "less than 2^53"));
      array.values[place] = value;
    }
  });
  return array;
}

NpyArray read_npy(const std::filesystem::path& path) { return parse_npy(read_file(path, largest_file), path.string()); }

std::string npy_header_bytes(const std::vector<std::size_t>& shape, NpyType type) {
  if (shape.size() > most_dimensions)
    throw UsageError(fmt::format("an array of {} dimensions: at most {}", shape.size(), most_dimensions));
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", to_string(type),
                                   fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  const std::size_t before = magic.size() + 2 + 2;
  header.append(alignment - 1 - (before + header.size()) % alignment, ' ');
  header += '\n';
  std::string bytes(magic);
  bytes += '\1';
  bytes += '\0';
  append_little_endian(bytes, static_cast<std::uint16_t>(header.size()));
  return bytes + header;
}

std::string npy_bytes(const NpyArray& array, NpyType type) {
  if (array.shape.size() > most_dimensions || product(array.shape) != array.values.size())
    throw UsageError(fmt::format("an array of shape ({}) does not hold {} values", fmt::join(array.shape, ", "),
                                 array.values.size()));
  std::string bytes = npy_header_bytes(array.shape, type);
  bytes.reserve(bytes.size() + array.values.size() * bytes_of(type));
  with_type(type, [&](auto zero) {
    using Number = decltype(zero);
    for (std::size_t i = 0; i < array.values.size(); ++i) {
      const double value = array.values[i];
      bool fits = true;
      if constexpr (std::integral<Number>) {
        // Compared before the conversion, which is undefined for what does not fit.
        const double most = type == NpyType::boolean ? 1 : static_cast<double>(std::numeric_limits<Number>::max());
        fits = std::abs(value) < largest_whole && value == std::floor(value) && value <= most &&
               value >= static_cast<double>(std::numeric_limits<Number>::min());
      } else {
        fits = !std::isfinite(value) || std::abs(value) <= static_cast<double>(std::numeric_limits<Number>::max());
      }
      if (!fits)
        throw UsageError(
            fmt::format("{} at [{}] does not fit the type {}", value, npy_place(array, i), to_string(type)));
      append_little_endian(bytes, std::bit_cast<WordOf<Number>>(static_cast<Number>(value)));
    }
  });
  return bytes;
}

void write_npy(const std::filesystem::path& path, const NpyArray& array, NpyType type) {
  write_file(path, npy_bytes(array, type));
}

}  // namespace folk::sct
