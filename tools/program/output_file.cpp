#include <folk/tools/program/output_file.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>

#include <cerrno>
#include <cstring>

#include <unistd.h>

namespace folk::tools {

namespace fs = std::filesystem;

void require_writable(const fs::path& file, const std::string& option) {
  const auto folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const auto fail = [&](const std::string& why) {
    throw EnvironmentError(fmt::format("{} {}: {}", option, excerpt(file.string(), 1000), why));
  };
  if (fs::is_directory(file)) fail("it is a directory; name a file in it");
  if (!fs::is_directory(folder)) fail("there is no such folder; make it or name another");
  if (!fs::exists(file) || fs::is_regular_file(file)) {
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
      fail(fmt::format("cannot be written: {}; name another place", std::strerror(errno)));
    remove_cut_off_writes(file);
  }
}

}  // namespace folk::tools
