#include <folk/tools/description/candidate.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace folk::tools {

std::vector<Candidate> path_candidates(std::string_view prefix, std::string_view path, PathKind kind) {
  namespace fs = std::filesystem;
  const auto slash = path.rfind('/');
  const std::string typed_folder(slash == std::string_view::npos ? "" : path.substr(0, slash + 1));
  const std::string_view begun = path.substr(typed_folder.size());
  std::string folder = typed_folder.empty() ? "." : typed_folder;
  if (const char* home = std::getenv("HOME"); home != nullptr && folder.starts_with("~/")) folder.replace(0, 1, home);

  std::vector<Candidate> candidates;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    const bool is_folder = entry->is_directory(ignored);
    if (!name.starts_with(begun) || (name.starts_with('.') && begun.empty())) continue;
    if (is_folder)
      candidates.push_back({std::string(prefix) + typed_folder + name + "/", {}, false});
    else if (kind == PathKind::file)
      candidates.push_back({std::string(prefix) + typed_folder + name});
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.text < b.text; });
  return candidates;
}

}  // namespace folk::tools
