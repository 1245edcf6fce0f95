#pragma once
// Collects a data set: plays episodes and writes their rows as they come, in constant memory but for 24 bytes an
// episode.

#include <folk/mpe/data/data_description.h>
#include <folk/mpe/players/player.h>

#include <cstddef>
#include <filesystem>
#include <functional>

namespace folk::mpe {

struct CollectRules {
  unsigned threads = 1;  ///< the files do not depend on it
  bool resume = false;   ///< goes on with what an earlier run left, or takes the data set that is there
  std::function<void(double)> progress = nullptr;  ///< told the share that is done, 0 to 1, by one thread at a time
  std::function<bool()> interrupted = nullptr;     ///< asked now and then; true ends the work
};

struct Collection {
  enum class End { complete, was_there, interrupted };
  End end = End::complete;
  std::size_t kept = 0;     ///< episodes that an earlier run had played
  std::size_t written = 0;  ///< episodes that are there now
  DataRecord record;        ///< unless interrupted
};

/// Writes the data set that `description` says: `cast` plays it, description.noise already added. Everything is written
/// into FOLDER.partial, which gets its name at the end: FOLDER is whole or not there. What a run leaves that was killed
/// or interrupted stays for another with `resume`, and is replaced without. What fails otherwise removes what it began.
///
/// Throws UsageError when the folder is there (with `resume`: and another data set's, or the players act otherwise than
/// when it was begun), InputFileError when it is there and damaged, EnvironmentError when it cannot be written or
/// another process writes it, and what play_episodes throws.
Collection collect(const Layout& layout, const Cast& cast, const DataDescription& description,
                   const std::filesystem::path& folder, const CollectRules& rules = {});

}  // namespace folk::mpe
