#pragma once
// The binary files in which a training run keeps itself: 8 bytes that name the kind, a word with the version, sections,
// a word with a checksum. Words and numbers are little endian; texts and lists begin with a word that holds their
// length.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace folk::sct {

/// What a kind of file is called.
struct RecordKind {
  std::string_view magic;  ///< 8 bytes
  std::uint64_t version = 1;
  std::string_view program;  ///< that writes it: "sct-train"
};

/// Puts a file together.
class RecordWriter {
public:
  explicit RecordWriter(const RecordKind& kind, std::size_t reserve = 0);

  void word(std::uint64_t word);
  /// Throws UsageError when a number is not finite: training has diverged.
  void real(double number);
  void floats(std::span<const float> numbers);
  void text(std::string_view text);
  void digits(std::span<const std::uint8_t> numbers) { bytes_.append(numbers.begin(), numbers.end()); }

  /// The file's bytes with their checksum.
  std::string sealed() &&;

private:
  std::string bytes_;
};

/// Takes a file apart from its front; every length is held against what is left, nothing in it is taken on trust.
class RecordReader {
public:
  /// Checks kind, version and checksum. `source` (a path) is what messages call the file and must outlive this. Throws
  /// InputFileError "source: what; mend", as all that follows.
  RecordReader(std::string_view bytes, const std::string& source, const RecordKind& kind);

  std::uint64_t word();
  /// A number of steps, below 2^53.
  std::uint64_t steps();
  std::uint64_t below(std::uint64_t bound, std::string_view what);
  /// How many elements follow, each of at least `element_bytes`.
  std::size_t count(std::size_t element_bytes);
  double real();
  std::vector<float> floats();
  std::vector<std::uint8_t> digits(std::size_t size, unsigned bound);
  std::string text();
  bool done() const { return bytes_.empty(); }

  [[noreturn]] void refuse(const std::string& what) const;
  /// Refuses it as damaged.
  [[noreturn]] void wrong(const std::string& what) const;

private:
  std::string_view take(std::size_t size);

  std::string_view bytes_;
  const std::string& source_;
};

}  // namespace folk::sct
