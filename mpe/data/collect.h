#pragma once
// Collects a data set: plays episodes and writes their rows as they come, in constant memory but for 24 bytes an
// episode.

#include <folk/games/progress.h>
#include <folk/mpe/data/data_description.h>
#include <folk/mpe/players/player.h>

#include <cstddef>
#include <filesystem>

namespace folk::mpe {

struct CollectRules {
  unsigned threads = 1;  ///< the files do not depend on it
  bool resume = false;   ///< goes on with what an earlier run left, or takes the data set that is there
};

struct Collection {
  enum class End { complete, was_there };
  End end = End::complete;
  std::size_t kept = 0;     ///< episodes that an earlier run had played
  std::size_t written = 0;  ///< episodes that are there now
  DataRecord record;
};

/// Thrown when a collection was cancelled. What is written stays, for a run with `resume`.
class CollectionCancelled : public Cancelled {
public:
  explicit CollectionCancelled(std::size_t episodes)
      : written(episodes) {}

  std::size_t written;  ///< episodes that are there now
};

/// Writes the data set that `description` says: `cast` plays it, description.noise already added. Everything is written
/// into FOLDER.partial, which gets its name at the end: FOLDER is whole or not there. What a run leaves that was killed
/// or cancelled stays for another with `resume`, and is replaced without. What fails otherwise, `progress` throwing
/// something else included, removes what it began.
///
/// Throws UsageError when the folder is there (with `resume`: and another data set's, or the players act otherwise than
/// when it was begun), InputFileError when it is there and damaged, EnvironmentError when it cannot be written or
/// another process writes it, CollectionCancelled, and what play_episodes throws.
Collection collect(const Layout& layout, const Cast& cast, const DataDescription& description,
                   const std::filesystem::path& folder, const CollectRules& rules = {},
                   const Progress& progress = nullptr);

}  // namespace folk::mpe
