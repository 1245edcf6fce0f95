#pragma once
// What a data set is: its metadata.json.

#include <folk/mpe/world/scenario.h>
#include <folk/sct/files/npy_file.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace folk::mpe {

inline constexpr std::string_view data_format = "folk-mpe-data";
inline constexpr std::uint64_t data_format_version = 1;
inline constexpr const char* metadata_name = "metadata.json";

/// How a data set is made: the same description gives the same bytes.
struct DataDescription {
  std::string folk_version;
  std::string scenario;
  RewardRule reward_rule = RewardRule::program;
  std::string level;  ///< random, medium or expert; empty where the players were named
  std::string predators;
  std::string prey;
  double noise = 0;  ///< standard deviation of what was added to the predators' actions
  std::uint64_t seed = 1;
  std::uint64_t first_episode = 0;  ///< its number among the seed's episodes
  std::size_t episodes = 0;
  std::size_t episode_steps = 25;
  sct::NpyType type = sct::NpyType::float32;  ///< float32 or float64

  std::size_t transitions() const { return episodes * episode_steps; }
};

/// Mean over episodes of an undiscounted sum of rewards, and its standard error, which one episode does not have.
struct MeanReturn {
  double mean = 0;
  std::optional<double> standard_error;
};

/// What came out.
struct DataFigures {
  std::uint64_t signature = 0;  ///< of all numbers, as data_figures has it
  MeanReturn predator;          ///< of predator 0; all predators earn the same
  MeanReturn prey;
};

struct DataRecord {
  DataDescription description;
  DataFigures figures;
};

/// The text of metadata.json, which parse_metadata reads back.
std::string metadata_text(const DataRecord& record);

/// Nothing for a JSON object of another format: other programs may keep notes of their own under this name. Throws
/// InputFileError "source: what; mend" for what is no object, or Folk's and damaged or newer.
std::optional<DataRecord> parse_metadata(std::string_view text, const std::string& source);

/// A description alone as text: what an unfinished data set keeps.
std::string description_text(const DataDescription& description);

/// The first thing in which two descriptions differ: "seed = 1 there, 2 here"; nothing when they are the same. `there`
/// is the text of one, or something else.
std::optional<std::string> difference(std::string_view there, const DataDescription& here);

}  // namespace folk::mpe
