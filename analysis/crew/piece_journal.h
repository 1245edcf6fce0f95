#pragma once
// The journal of shared work: a file to which each piece is added as it is finished.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace folk {

/// What such a file begins with; `identity` is that of the first work that is kept in it.
std::string piece_journal_head(std::uint64_t identity);

/// What is added for a piece of a work, sealed by itself.
std::string piece_record(std::uint64_t identity, std::size_t piece, std::string_view bytes);

/// A file's pieces, which point into its text.
struct PieceJournal {
  std::map<std::pair<std::uint64_t, std::size_t>, std::string_view> pieces{};  ///< by the work's identity and number
  std::size_t whole = 0;  ///< bytes up to the end of the last record that is whole: what follows was cut off
};

/// Reads a journal that was begun with `identity`. A last record that was cut off, or whose bytes never came to the
/// disk, does not count. Throws InputFileError, naming `source`, for a file of another kind, the journal of other work,
/// and one that is damaged.
PieceJournal read_piece_journal(std::string_view text, const std::string& source, std::uint64_t identity);

}  // namespace folk
