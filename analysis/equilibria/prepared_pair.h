#pragma once
// Two machines made ready for what is asked of their pair: each prepared once, and their path played once.

#include <folk/analysis/play/play_path.h>
#include <folk/analysis/replies/prepared_machine.h>

#include <optional>

namespace folk {

/// A pair under one criterion.
class PreparedPair {
public:
  /// Both machines, which may be the same, must outlive this and be prepared under the same rules.
  /// `horizon`: rounds that machines without end are followed, under criteria without end.
  /// Throws UsageError for noise 1, when one has no end, the criterion has none and there is no horizon (for a pair
  /// that mixes or slips and for mean: always), and as play_path does.
  PreparedPair(PreparedMachine& first, PreparedMachine& second, unsigned horizon = 0);

  PreparedMachine& first() const { return first_; }
  PreparedMachine& second() const { return second_; }
  unsigned horizon() const { return horizon_; }

  /// What is played where nothing happens by chance, as the first machine sees it; nothing where one of them mixes or
  /// slips.
  const std::optional<PlayPath>& path() const { return path_; }

private:
  PreparedMachine& first_;
  PreparedMachine& second_;
  unsigned horizon_;
  std::optional<PlayPath> path_;
};

}  // namespace folk
