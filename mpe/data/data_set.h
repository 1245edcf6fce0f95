#pragma once
// Offline data of the particle world: a folder of .npy files, read where they lie on the disk.
//
// The files are those of data_layout.h, written by Folk or by others. The widths of the observations tell the scenario.

#include <folk/mpe/data/data_description.h>
#include <folk/mpe/data/data_layout.h>
#include <folk/mpe/data/mapped_file.h>
#include <folk/mpe/data/number_table.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// Which data sets are taken.
struct DataSetRules {
  std::optional<std::string> scenario;  ///< of this one only
  /// Episodes as long as metadata.json says instead of 25 steps.
  bool any_episode_length = false;
  unsigned threads = 1;  ///< of the checks
};

class DataSet {
public:
  /// Opens a folder and checks all that is in it. Each file is float32 or float64 (dones also whole numbers or truth
  /// values), in C order; rewards and dones are [N] or [N, 1]. Throws InputFileError "file: what; mend" for files that
  /// are missing or no arrays, shapes that do not fit each other or a scenario, rows that make no whole episodes, a
  /// number that is not finite as a float, a done other than 0 and 1, and a next observation that is not the following
  /// row's inside an episode, or is between two episodes: their length is another then.
  static DataSet open(const std::filesystem::path& folder, const DataSetRules& rules = {});

  /// The same from bytes in memory, which must outlive it: `file(name)` gives those of a file, nothing for one that is
  /// missing; `source` is what messages call their folder.
  using Files = std::function<std::optional<std::string_view>(const std::string& name)>;
  static DataSet parse(const Files& file, const std::string& source, const DataSetRules& rules = {});

  const Scenario& scenario() const { return scenario_; }
  std::size_t agents() const { return scenario_.agents(); }
  std::size_t transitions() const { return transitions_; }
  std::size_t episodes() const { return transitions_ / episode_steps(); }
  std::size_t episode_steps() const { return scenario_.episode_steps; }

  /// What its metadata.json says; nothing when it has none, or not one of Folk's.
  const std::optional<DataRecord>& record() const { return record_; }
  const std::string& source() const { return source_; }

  /// Writes row `row` of an agent's observations to `numbers`, which has scenario().observation_size(agent) places.
  void observation(std::size_t agent, std::size_t row, std::span<float> numbers) const {
    table(DataField::observation, agent).row(row, numbers);
  }
  void next_observation(std::size_t agent, std::size_t row, std::span<float> numbers) const {
    table(DataField::next_observation, agent).row(row, numbers);
  }
  void action(std::size_t agent, std::size_t row, std::span<float, 2> numbers) const {
    table(DataField::action, agent).row(row, numbers);
  }
  float reward(std::size_t agent, std::size_t row) const { return table(DataField::reward, agent).at(row); }
  bool done(std::size_t agent, std::size_t row) const { return table(DataField::done, agent).at(row) != 0; }

  const NumberTable& table(DataField field, std::size_t agent) const { return tables_[data_file_index(field, agent)]; }

  /// The bytes of an episode's rows in each file, in the order of data_files.
  std::vector<std::string_view> episode_bytes(std::size_t episode) const;

private:
  DataSet() = default;
  void read_tables(const Files& file);
  void read_record(const Files& file, const DataSetRules& rules);
  void require_shapes(const DataSetRules& rules);
  void require_numbers(unsigned threads) const;
  void require_numbers_in(std::size_t begin, std::size_t end) const;
  void require_succession(std::size_t agent, std::size_t begin, std::size_t end) const;
  [[noreturn]] void refuse(const std::string& file, const std::string& why) const;

  std::string source_;
  Scenario scenario_;
  std::size_t transitions_ = 0;
  std::vector<NumberTable> tables_;
  std::optional<DataRecord> record_;
  std::vector<MappedFile> mapped_;
};

}  // namespace folk::mpe
