#include <folk/tools/program/output_folder.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include <unistd.h>

namespace folk::tools {

std::optional<std::filesystem::path> output_folder(const po::variables_map& values) {
  if (values.count("output") == 0) return std::nullopt;
  std::filesystem::path folder = text_option(values, "output");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw EnvironmentError(fmt::format("--output '{}': no folder of that name can be made: {}", folder.string(),
                                       error ? error.message() : "a file has it"));
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw EnvironmentError(fmt::format("--output '{}': cannot be written: {}", folder.string(), std::strerror(errno)));
  return folder;
}

}  // namespace folk::tools
