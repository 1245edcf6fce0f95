#pragma once
// Episodes that the published program played: some always in tests/data/mpe, all of them in the reference folder.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe::testing {

inline std::filesystem::path golden_data(const std::string& name) {
  return std::filesystem::path(FOLK_SOURCE_DIR) / "tests/data/mpe" / name;
}

/// tag_NN.csv and world_NN.csv, or what ends otherwise; whole ones where there are some.
inline std::vector<std::filesystem::path> golden_recordings(std::string_view ending = {}) {
  const char* folder = std::getenv("FOLK_REFERENCE");
  const std::filesystem::path root = folder != nullptr ? folder : FOLK_SOURCE_DIR "/../shared/reference";
  std::map<std::string, std::filesystem::path> files;
  for (const auto& where : {root / "mpe", golden_data("")})
    if (std::filesystem::is_directory(where))
      for (const auto& entry : std::filesystem::directory_iterator(where)) {
        const std::string name = entry.path().stem().string();
        const auto underline = name.find('_');
        if (entry.path().extension() != ".csv" || underline == std::string::npos ||
            (name.substr(0, underline) != "tag" && name.substr(0, underline) != "world"))
          continue;
        const std::string rest = name.substr(underline + 1);
        const bool numbered = rest.find_first_not_of("0123456789") == std::string::npos;
        if (ending.empty() ? numbered : rest == ending) files.emplace(name, entry.path());
      }
  std::vector<std::filesystem::path> paths;
  for (const auto& [name, path] : files) paths.push_back(path);
  return paths;
}

}  // namespace folk::mpe::testing
