#include <folk/games/error.h>
#include <folk/sct/files/checksum.h>
#include <folk/sct/files/little_endian.h>
#include <folk/sct/files/record_bytes.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace folk::sct {
namespace {

constexpr std::size_t word_bytes = 8;
constexpr std::size_t longest_text = 1 << 16;
constexpr std::uint64_t most_steps = std::uint64_t{1} << 53U;

/// Over whole words, then over the bytes that are left.
std::uint64_t checksum(std::string_view bytes) {
  Checksum sum;
  std::size_t at = 0;
  for (; at + word_bytes <= bytes.size(); at += word_bytes)
    sum.add(load_little_endian<std::uint64_t>(bytes.substr(at)));
  sum.add(bytes.substr(at));
  return sum.value();
}

void require_finite(double number) {
  if (!std::isfinite(number))
    throw UsageError("training has diverged, its numbers are not finite: lower learning-rate or clip");
}

}  // namespace

RecordWriter::RecordWriter(const RecordKind& kind, std::size_t reserve)
    : bytes_(kind.magic) {
  bytes_.reserve(reserve);
  word(kind.version);
}

void RecordWriter::word(std::uint64_t word) { append_little_endian(bytes_, word); }

void RecordWriter::real(double number) {
  require_finite(number);
  word(std::bit_cast<std::uint64_t>(number));
}

void RecordWriter::floats(std::span<const float> numbers) {
  word(numbers.size());
  for (const float number : numbers) {
    require_finite(static_cast<double>(number));
    append_little_endian(bytes_, std::bit_cast<std::uint32_t>(number));
  }
}

void RecordWriter::text(std::string_view text) {
  word(text.size());
  bytes_ += text;
}

std::string RecordWriter::sealed() && {
  word(checksum(bytes_));
  return std::move(bytes_);
}

RecordReader::RecordReader(std::string_view bytes, const std::string& source, const RecordKind& kind)
    : source_(source) {
  if (!bytes.starts_with(kind.magic) || bytes.size() < kind.magic.size() + 2 * word_bytes)
    refuse(fmt::format("no checkpoint of {}, or only its beginning; remove it", kind.program));
  const auto found = load_little_endian<std::uint64_t>(bytes.substr(kind.magic.size()));
  if (found != kind.version)
    refuse(fmt::format("a checkpoint of version {}, but this Folk reads {}; use the Folk that wrote it", found,
                       kind.version));
  const auto end = bytes.size() - word_bytes;
  if (load_little_endian<std::uint64_t>(bytes.substr(end)) != checksum(bytes.substr(0, end)))
    wrong("its checksum is another");
  bytes_ = bytes.substr(kind.magic.size() + word_bytes, end - kind.magic.size() - word_bytes);
}

void RecordReader::refuse(const std::string& what) const {
  throw InputFileError(fmt::format("{}: {}", excerpt(source_, 1000), what));
}

void RecordReader::wrong(const std::string& what) const {
  refuse(fmt::format("damaged checkpoint: {}; remove it and resume from the one before", what));
}

std::string_view RecordReader::take(std::size_t size) {
  if (size > bytes_.size()) refuse("damaged checkpoint: ends too soon; remove it and resume from the one before");
  const auto taken = bytes_.substr(0, size);
  bytes_.remove_prefix(size);
  return taken;
}

std::uint64_t RecordReader::word() { return load_little_endian<std::uint64_t>(take(word_bytes)); }

std::uint64_t RecordReader::steps() { return below(most_steps, "steps"); }

std::uint64_t RecordReader::below(std::uint64_t bound, std::string_view what) {
  const auto number = word();
  if (number >= bound) wrong(fmt::format("{} {}", number, what));
  return number;
}

std::size_t RecordReader::count(std::size_t element_bytes) {
  const auto elements = word();
  if (elements > bytes_.size() / element_bytes) wrong(fmt::format("a list of {} elements", elements));
  return static_cast<std::size_t>(elements);
}

double RecordReader::real() {
  const auto number = std::bit_cast<double>(word());
  if (!std::isfinite(number)) wrong("a number that is not finite");
  return number;
}

std::vector<float> RecordReader::floats() {
  std::vector<float> numbers(count(sizeof(float)));
  for (float& number : numbers) {
    number = std::bit_cast<float>(load_little_endian<std::uint32_t>(take(sizeof(float))));
    if (!std::isfinite(number)) wrong("a number that is not finite");
  }
  return numbers;
}

std::vector<std::uint8_t> RecordReader::digits(std::size_t size, unsigned bound) {
  const auto taken = take(size);
  std::vector<std::uint8_t> numbers(taken.begin(), taken.end());
  if (std::any_of(numbers.begin(), numbers.end(), [&](std::uint8_t number) { return number >= bound; }))
    wrong("a lesson with an impossible move");
  return numbers;
}

std::string RecordReader::text() {
  const auto size = count(1);
  if (size > longest_text) wrong("settings that are too long");
  return std::string(take(size));
}

}  // namespace folk::sct
