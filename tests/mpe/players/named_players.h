#pragma once
// Controllers by name, with a folder of policies that stand for those that are shipped.

#include <folk/mpe/players/names.h>
#include <folk/mpe/players/policy_file.h>

#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace folk::mpe::testing {

/// A folder that is gone when it goes.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "folk_players_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// Small policies of both sides and scenarios, under the names of those that are shipped.
class StandInPolicies {
public:
  StandInPolicies() {
    for (const char* name : {"simple_tag", "simple_world"}) {
      const auto scenario = Scenario::named(name);
      write_policy(file(name, "expert"), untrained_policy(scenario, Side::predators, 1, 8));
      write_policy(file(name, "medium"), untrained_policy(scenario, Side::predators, 2, 8));
      write_policy(file(name, "released"), untrained_policy(scenario, Side::prey, 3, 8));
      write_policy(file(name, "maddpg"), untrained_policy(scenario, Side::prey, 4, 8));
    }
  }

  const std::filesystem::path& folder() const { return folder_.path(); }
  std::filesystem::path file(const std::string& scenario, const std::string& name) const {
    return folder_.path() / (scenario + "_" + name + ".safetensors");
  }

private:
  TemporaryFolder folder_;
};

}  // namespace folk::mpe::testing
