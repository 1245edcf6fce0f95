#include <folk/tools/program/data_folder.h>

#include <cstdlib>
#include <system_error>
#include <utility>

namespace folk::tools {

namespace fs = std::filesystem;

namespace {

fs::path& chosen_folder() {
  static fs::path folder;
  return folder;
}

}  // namespace

void use_data_folder(fs::path folder) { chosen_folder() = std::move(folder); }

fs::path data_folder() {
  if (const char* folder = std::getenv("FOLK_DATA"); folder != nullptr && *folder != '\0') return folder;
  if (!chosen_folder().empty()) return chosen_folder();
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / FOLK_DATA_FROM_PROGRAM).lexically_normal();
}

}  // namespace folk::tools
