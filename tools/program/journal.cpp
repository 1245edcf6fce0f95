#include <folk/tools/program/journal.h>

#include <folk/tools/program/launch.h>
#include <folk/tools/program/output_file.h>

#include <folk/analysis/evolution/evolution_journal.h>
#include <folk/games/text_file.h>

#include <algorithm>

namespace folk::tools {
namespace {

constexpr auto pause = std::chrono::seconds(2);
constexpr auto first_pause = std::chrono::milliseconds(200);

}  // namespace

Journal::Journal(std::optional<std::filesystem::path> path)
    : path_(std::move(path)),
      next_(Clock::now() + first_pause) {
  if (!speaks()) path_.reset();
  if (path_) require_writable(*path_, "--journal");
}

std::optional<std::string> Journal::read() const {
  if (std::error_code ignored; !path_ || !std::filesystem::exists(*path_, ignored)) return std::nullopt;
  return read_ordinary_file(*path_, largest_journal);
}

void Journal::now_and_then(const std::function<std::string()>& text) {
  if (!path_) return;
  const auto begin = Clock::now();
  if (begin < next_) return;
  write(text());
  const auto end = Clock::now();
  next_ = end + std::max<Clock::duration>(pause, 9 * (end - begin));
}

void Journal::write(const std::string& text) {
  if (path_) write_file(*path_, text);
}

}  // namespace folk::tools
