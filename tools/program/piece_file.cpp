#include <folk/tools/program/interruption.h>
#include <folk/tools/program/launch.h>
#include <folk/tools/program/output_file.h>
#include <folk/tools/program/piece_file.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/progress.h>
#include <folk/games/text_file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace folk::tools {
namespace {

/// No journal of pieces is larger than this.
constexpr std::size_t largest_piece_file = std::size_t{4} << 30U;

/// How often the disk is waited for; a kill loses nothing, a power cut so much.
constexpr auto sync_pause = std::chrono::seconds(2);

}  // namespace

PieceFile::PieceFile(std::filesystem::path path)
    : path_(std::move(path)) {
  require_writable(path_, "--journal");
}

PieceFile::~PieceFile() {
  if (file_ >= 0) ::close(file_);
}

void PieceFile::begin(std::uint64_t identity, std::size_t pieces) {
  if (file_ < 0) open(identity);
  identity_ = identity;
  pieces_ = pieces;
  done_ = 0;
}

void PieceFile::open(std::uint64_t identity) {
  if (std::filesystem::exists(path_)) {
    text_ = read_ordinary_file(path_, largest_piece_file);
    found_ = read_piece_journal(text_, path_.string(), identity);
  } else {
    const std::string head = piece_journal_head(identity);
    write_file(path_, head);
    found_.whole = head.size();
  }
  file_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file_ < 0) refuse();
  if (text_.size() > found_.whole && ::ftruncate(file_, static_cast<off_t>(found_.whole)) != 0) refuse();
  next_sync_ = Clock::now() + sync_pause;
}

std::optional<std::string> PieceFile::find(std::size_t piece) {
  const auto found = found_.pieces.find({identity_, piece});
  if (found == found_.pieces.end()) return std::nullopt;
  ++done_;
  return std::string(found->second);
}

void PieceFile::keep(std::size_t piece, std::string_view bytes) {
  write(piece_record(identity_, piece, bytes));
  ++done_;
  const auto begin = Clock::now();
  if (begin < next_sync_) return;
  if (::fdatasync(file_) != 0) refuse();
  const auto end = Clock::now();
  next_sync_ = end + std::max<Clock::duration>(sync_pause, 9 * (end - begin));
}

void PieceFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) refuse();
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void PieceFile::refuse() const {
  throw EnvironmentError(
      fmt::format("--journal '{}': cannot be written: {}", excerpt(path_.string(), 1000), std::strerror(errno)));
}

std::string PieceFile::how_far() const { return fmt::format("{} of {} pieces", done_, pieces_); }

void run_kept(const po::variables_map& values, const std::function<void(const std::function<bool()>& ended)>& work) {
  const bool kept = values.count("journal") != 0;
  std::optional<PieceFile> file;
  if (kept && speaks()) file.emplace(text_option(values, "journal"));
  if (!kept && crew().ranks() == 1) return work(nullptr);
  crew().keep_in(file ? &*file : nullptr);
  const Interruption interruption;
  try {
    work(Interruption::requested);
    crew().keep_in(nullptr);
  } catch (const Cancelled&) {
    crew().keep_in(nullptr);
    end_interrupted(kept, file ? file->how_far() : "a part of it");
  } catch (...) {
    crew().keep_in(nullptr);
    throw;
  }
}

}  // namespace folk::tools
