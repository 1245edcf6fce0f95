#pragma once
// Writes the files of a data set, an episode's rows at their place, in any order and from any thread.

#include <folk/games/file_descriptor.h>
#include <folk/mpe/data/data_layout.h>
#include <folk/mpe/data/episode_rows.h>
#include <folk/sct/files/npy_file.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace folk::mpe {

/// Beside the files stands a journal until they are finished: a word an episode, its episode_signature once its rows
/// are written. So a run that died goes on with what it had, and rows that never reached the disk are seen not to be
/// there.
class DataWriter {
public:
  /// Opens the files in a folder, or makes them and reserves their space. Throws EnvironmentError, naming the file,
  /// when that cannot be done or there is no room.
  DataWriter(std::filesystem::path folder, const Scenario& scenario, sct::NpyType type, std::size_t episodes);

  std::size_t episodes() const { return episodes_; }

  /// Bytes of all files, headers included.
  std::size_t total_bytes() const { return total_bytes_; }

  /// Writes the rows of some episodes from `first` on. Throws EnvironmentError.
  void write(std::size_t first, const RowBytes& rows);

  /// For each episode whether its rows are there. Throws EnvironmentError when a file cannot be read.
  std::vector<bool> written(unsigned threads) const;

  /// The journal's word of an episode; 0 when its rows are not there.
  std::uint64_t signature(std::size_t episode) const;

  /// Waits until the disk has everything. Nothing can be written any more. Throws EnvironmentError.
  void finish();

  /// The last thing to do: what is there cannot be gone on with any more. Throws EnvironmentError.
  void remove_journal();

private:
  struct File {
    std::filesystem::path path;
    FileDescriptor descriptor;
    std::size_t begin = 0;          ///< bytes before the first row
    std::size_t episode_bytes = 0;  ///< bytes of an episode's rows
  };

  static File opened(std::filesystem::path path, std::size_t begin, std::size_t episode_bytes, std::size_t episodes);
  std::vector<bool> written_in(std::size_t begin, std::size_t end) const;

  std::size_t episodes_;
  std::size_t total_bytes_ = 0;
  std::vector<File> files_;
  File journal_;
};

/// The signatures of some episodes, one after the other in `rows`, of which each file has `episode_bytes`.
std::vector<std::uint64_t> episode_signatures(const RowBytes& rows, const std::vector<std::size_t>& episode_bytes);

}  // namespace folk::mpe
