#pragma once
// Episodes as the rows of a data set's files, gathered while they are played.

#include <folk/mpe/data/data_layout.h>
#include <folk/mpe/evaluation/episodes.h>
#include <folk/sct/files/npy_file.h>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// The bytes of some episodes' rows, one text a file in the order of data_files.
using RowBytes = std::vector<std::string>;

/// Watches up to 64 episodes and hands their rows on when the last step is taken.
class EpisodeRows final : public Watcher {
public:
  /// Given the rows and how many episodes they are. It may throw.
  using Finished = std::function<void(const RowBytes& rows, std::size_t episodes)>;

  /// Numbers are written as `type`, float32 or float64.
  EpisodeRows(const Layout& layout, sct::NpyType type, Finished finished);

  /// Throws UsageError, naming the agent, when an action is too large for a float.
  void acted(const Layout& layout, const Block& block, const Moment& moment) override;
  void stepped(const Layout& layout, const Block& block, const Moment& moment) override;

private:
  void make_room(const Layout& layout, std::size_t lanes);
  void put(const Layout& layout, DataFile file, const double* rows, std::size_t lanes, std::size_t step);

  sct::NpyType type_;
  Finished finished_;
  RowBytes bytes_;
};

}  // namespace folk::mpe
