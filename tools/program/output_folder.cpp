#include <folk/tools/program/output_folder.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/sct/files/made_folder.h>
#include <folk/tools/program/launch.h>

#include <cerrno>
#include <cstring>
#include <list>
#include <system_error>

#include <unistd.h>

namespace folk::tools {

void make_folder(const std::filesystem::path& folder, std::error_code& error) {
  static std::list<sct::MadeFolder> made;
  made.emplace_front(folder, error);  // the last one made is the first to go
}

std::optional<std::filesystem::path> output_folder(const po::variables_map& values) {
  if (values.count("output") == 0 || !speaks()) return std::nullopt;
  std::filesystem::path folder = text_option(values, "output");
  std::error_code error, ignored;
  make_folder(folder, error);
  if (!std::filesystem::is_directory(folder, ignored))
    throw EnvironmentError(fmt::format("--output '{}': no folder of that name can be made: {}",
                                       excerpt(folder.string(), 1000), error ? error.message() : "a file has it"));
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw EnvironmentError(
        fmt::format("--output '{}': cannot be written: {}", excerpt(folder.string(), 1000), std::strerror(errno)));
  return folder;
}

}  // namespace folk::tools
