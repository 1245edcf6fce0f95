#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/tools/program/output_file.h>

#include <fmt/format.h>

namespace folk::tools {

void require_writable(const std::filesystem::path& file, const std::string& option) {
  if (file.empty()) throw UsageError(fmt::format("{} '': expected the name of a file", option));
  try {
    folk::require_writable(file);
  } catch (const EnvironmentError& error) {
    throw EnvironmentError(fmt::format("{} {}", option, error.what()));
  }
  remove_cut_off_writes(folder_of(file));
}

}  // namespace folk::tools
