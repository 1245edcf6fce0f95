#include <folk/mpe/data/data_layout.h>

#include <fmt/format.h>

namespace folk::mpe {
namespace {

constexpr const char* prefixes[] = {"obs", "acs", "rews", "next_obs", "dones"};

}  // namespace

std::string DataFile::name() const {
  return fmt::format("{}_{}.npy", prefixes[static_cast<std::size_t>(field)], agent);
}

std::size_t DataFile::width(const Scenario& scenario) const {
  switch (field) {
    case DataField::observation:
    case DataField::next_observation: return scenario.observation_size(agent);
    case DataField::action: return 2;
    case DataField::reward:
    case DataField::done: return 1;
  }
  return 0;
}

std::vector<std::size_t> DataFile::shape(const Scenario& scenario, std::size_t rows) const {
  if (field == DataField::reward || field == DataField::done) return {rows};
  return {rows, width(scenario)};
}

std::vector<DataFile> data_files(std::size_t agents) {
  std::vector<DataFile> files;
  for (std::size_t agent = 0; agent < agents; ++agent)
    for (const DataField field :
         {DataField::observation, DataField::action, DataField::reward, DataField::next_observation, DataField::done})
      files.push_back({field, agent});
  return files;
}

}  // namespace folk::mpe
