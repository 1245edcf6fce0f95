#pragma once
// What learns from a data set, one gradient step after another, never meeting the world.

#include <folk/sct/files/record_bytes.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// A quantity that a step measured before it moved: "critic", "belief", ...
struct NamedLoss {
  std::string_view name;
  double value = 0;
};

/// A learner of predators. A step draws from the seed and the step's number alone, so a run that is saved and loaded
/// goes on as if it had never stopped; its bits do not depend on the number of threads.
class OfflineLearner {
public:
  virtual ~OfflineLearner() = default;

  /// Gradient steps taken so far.
  virtual std::uint64_t steps() const = 0;

  /// Takes one; of several networks all that move in a step. Always the same names in the same order. Losses that are
  /// no numbers are returned as such: the caller stops.
  virtual std::vector<NamedLoss> step() = 0;

  /// All that changes from step to step, and back. `load` throws InputFileError, through the reader, for numbers of
  /// another network, and then nothing has changed.
  virtual void save(sct::RecordWriter& writer) const = 0;
  virtual void load(sct::RecordReader& reader) = 0;

  /// All that the run depends on besides the data and the number of steps: one "key = value" a line.
  virtual std::string description() const = 0;

  /// The policy as it now stands: the bytes of a policy file with these notes in its metadata.
  virtual std::string policy(const std::map<std::string, std::string>& notes) const = 0;
};

}  // namespace folk::mpe
