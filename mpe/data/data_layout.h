#pragma once
// Which files a data set of the particle world has, as loaders of offline multi-agent data expect them (OMAR: Pan et
// al. 2022, and what reuses its data).
//
//   obs_i.npy       [N, width]  what agent i observes before it acts
//   acs_i.npy       [N, 2]      its action
//   rews_i.npy      [N]         its reward of the step
//   next_obs_i.npy  [N, width]  what it observes after the step
//   dones_i.npy     [N]         1 where the world ended; it never does, so 0: an episode's last row is its 25th
//
// i = 0..3: the predators, then the prey. Rows are transitions in time order, one episode after the other.

#include <folk/mpe/world/scenario.h>

#include <cstddef>
#include <string>
#include <vector>

namespace folk::mpe {

enum class DataField { observation, action, reward, next_observation, done };

/// One file: a field of one agent.
struct DataFile {
  DataField field = DataField::observation;
  std::size_t agent = 0;

  std::string name() const;                                                          ///< "next_obs_3.npy"
  std::size_t width(const Scenario& scenario) const;                                 ///< numbers in a row
  std::vector<std::size_t> shape(const Scenario& scenario, std::size_t rows) const;  ///< as Folk writes it
  bool operator==(const DataFile&) const = default;
};

/// The files of a data set: each agent's five, in the order of DataField, agent after agent.
std::vector<DataFile> data_files(std::size_t agents);

/// The place of a file in data_files.
inline std::size_t data_file_index(DataField field, std::size_t agent) {
  return 5 * agent + static_cast<std::size_t>(field);
}

/// Episodes that a thread takes at a time where it works on them alone.
inline constexpr std::size_t episodes_in_piece = 64;

}  // namespace folk::mpe
