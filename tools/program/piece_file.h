#pragma once
// The file of --journal for shared work: each piece is added to it as it is finished, so that a kill loses little.

#include <folk/tools/program/program.h>

#include <folk/analysis/crew/crew.h>
#include <folk/analysis/crew/piece_journal.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace folk::tools {

class PieceFile : public PieceStore {
public:
  /// Throws EnvironmentError where the file cannot be written.
  explicit PieceFile(std::filesystem::path path);
  ~PieceFile() override;
  PieceFile(const PieceFile&) = delete;
  PieceFile& operator=(const PieceFile&) = delete;

  // The first work decides whose file it is. They throw InputFileError and EnvironmentError.
  void begin(std::uint64_t identity, std::size_t pieces) override;
  std::optional<std::string> find(std::size_t piece) override;
  void keep(std::size_t piece, std::string_view bytes) override;

  /// "37 of 128 pieces", of the work that began last.
  std::string how_far() const;

private:
  using Clock = std::chrono::steady_clock;

  void open(std::uint64_t identity);
  void write(std::string_view bytes);
  [[noreturn]] void refuse() const;

  std::filesystem::path path_;
  int file_ = -1;
  std::string text_;  // of the file as it was found
  PieceJournal found_;
  std::uint64_t identity_ = 0;
  std::size_t pieces_ = 0;
  std::size_t done_ = 0;
  Clock::time_point next_sync_;
};

/// Runs work that `crew()` shares, with --journal FILE if that is given. SIGINT and SIGTERM end it then, and where it
/// is shared, in good order: throws EnvironmentError with how far it got.
void run_kept(const po::variables_map& values, const std::function<void(const std::function<bool()>& ended)>& work);

}  // namespace folk::tools
