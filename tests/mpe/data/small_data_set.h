#pragma once
// A small data set in memory, put together from recorded episodes one number at a time.

#include <folk/mpe/data/data_description.h>
#include <folk/mpe/data/data_set.h>
#include <folk/mpe/evaluation/episode_record.h>
#include <folk/mpe/players/scripted.h>
#include <folk/sct/files/npy_file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace folk::mpe::test {

using Files = std::map<std::string, std::string>;  ///< bytes by name

/// A file's numbers, for tests that change them.
using Arrays = std::map<std::string, sct::NpyArray>;

inline Cast pursuit_cast() { return {lead_pursuit(), random_player()}; }

inline void append(sct::NpyArray& array, const std::vector<double>& row) {
  array.values.insert(array.values.end(), row.begin(), row.end());
  ++array.shape[0];
}

/// What collecting these episodes must write.
inline Arrays played_arrays(const Layout& layout, const Cast& cast, std::uint64_t seed, std::uint64_t first,
                            std::size_t episodes) {
  Arrays arrays;
  for (std::size_t e = 0; e < episodes; ++e) {
    const auto record = record_episode(layout, cast, seed, first + e);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::string file = std::to_string(i) + ".npy";
      const auto array = [&](const char* name, const std::vector<std::size_t>& shape) -> sct::NpyArray& {
        return arrays.try_emplace(name + file, sct::NpyArray{shape, {}}).first->second;
      };
      auto& obs = array("obs_", {0, layout.scenario().observation_size(i)});
      auto& next = array("next_obs_", {0, layout.scenario().observation_size(i)});
      auto& acs = array("acs_", {0, 2});
      auto& rews = array("rews_", {0});
      auto& dones = array("dones_", {0});
      for (std::size_t t = 1; t < record.rows.size(); ++t) {
        append(obs, record.rows[t - 1].observations[i]);
        append(acs, {record.rows[t].actions[i].x, record.rows[t].actions[i].y});
        append(rews, {record.rows[t].rewards[i]});
        append(next, record.rows[t].observations[i]);
        append(dones, {0});
      }
    }
  }
  return arrays;
}

inline Files files_of(const Arrays& arrays, sct::NpyType type = sct::NpyType::float32) {
  Files files;
  for (const auto& [name, array] : arrays) files[name] = npy_bytes(array, type);
  return files;
}

inline DataSet parse(const Files& files, const DataSetRules& rules = {}) {
  return DataSet::parse(
      [&](const std::string& name) -> std::optional<std::string_view> {
        const auto found = files.find(name);
        if (found == files.end()) return std::nullopt;
        return found->second;
      },
      "set", rules);
}

/// A folder that goes when the test ends.
class Folder {
public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "folk-data-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

  /// What is in it or in a folder below, by name.
  std::vector<std::string> names(const std::string& below = {}) const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(below.empty() ? path_ : path_ / below))
      found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
  }

private:
  std::filesystem::path path_;
};

inline DataDescription description(const Layout& layout, const Cast& cast, std::size_t episodes) {
  DataDescription description;
  description.folk_version = "test";
  description.scenario = layout.scenario().name;
  description.reward_rule = layout.scenario().rewards.rule;
  description.predators = cast.predators.name;
  description.prey = cast.prey.name;
  description.episodes = episodes;
  description.episode_steps = layout.scenario().episode_steps;
  return description;
}

}  // namespace folk::mpe::test
