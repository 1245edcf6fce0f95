#pragma once
// Comma-separated values line by line, as tables of scores and recorded play are read.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// The lines of a CSV (RFC 4180, every record a line) that are not empty, one after the other.
class CsvLines {
public:
  /// `text` must outlive this; `source` is what messages call it.
  CsvLines(std::string_view text, std::string source);

  /// Goes on to the next line; false when there is none. Throws InputFileError on a quote that is not closed and on
  /// text after one that is.
  bool next();

  /// Of the line: where it stands, from 1 on, and its fields; quotes around one are taken off, doubled ones inside are
  /// one.
  std::size_t number() const { return number_; }
  const std::vector<std::string>& fields() const { return fields_; }

  /// Throws InputFileError "source:line: why", about this line or another.
  [[noreturn]] void refuse(std::string_view why) const { refuse(number_, why); }
  [[noreturn]] void refuse(std::size_t line, std::string_view why) const;

private:
  void split(std::string_view line);

  std::string_view rest_;
  std::string source_;
  std::size_t number_ = 0;
  std::vector<std::string> fields_;
};

}  // namespace folk
