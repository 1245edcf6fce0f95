#pragma once
// What policy files of all kinds are read and written through: words of metadata, tensors by their names, networks
// layer by layer.

#include <folk/mpe/network/policy_network.h>
#include <folk/sct/files/safetensors.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

using TensorShape = std::vector<std::uint64_t>;

/// Takes words and tensors out of a file by name, so that what is left at the end was not asked for. All that it
/// refuses is an InputFileError "source: why".
class PolicyReader {
public:
  /// Reads safetensors; `source` (a path) is what messages call them.
  PolicyReader(std::string_view bytes, std::string source);

  [[noreturn]] void refuse(const std::string& why) const;

  const std::map<std::string, std::string>& metadata() const { return file_.metadata; }

  /// A word of the metadata, which then is no longer there. Refuses one that is missing.
  std::string take_word(const std::string& key);

  bool has(const std::string& tensor) const { return file_.tensors.contains(tensor); }

  /// Refuses a tensor that is missing.
  const TensorShape& shape(const std::string& tensor) const;

  /// The numbers of a tensor, which then is no longer there. Refuses another shape, other types than F32 and numbers
  /// that are not finite.
  std::vector<float> take(const std::string& tensor, const TensorShape& wanted);

  void forget(const std::string& tensor) { file_.tensors.erase(tensor); }

  void require_nothing_left() const;

private:
  std::string source_;
  sct::SafetensorsFile file_;
};

/// A network as a file holds it.
struct StoredNetwork {
  MlpShape shape;
  std::vector<float> parameters;
};

/// Takes layers prefix + "fc1", "fc2", ..., each of .weight [outputs, inputs] and .bias [outputs]. Refuses more than 16
/// of them, widths above 4096 and a layer that does not follow the one before.
StoredNetwork take_stored_network(PolicyReader& reader, const std::string& prefix);

/// The same of a network of two outputs, an action. Its squash is left as it was made.
PolicyNetwork take_network(PolicyReader& reader, const std::string& prefix);

/// Gathers the tensors of a file that PolicyReader reads. It takes numbers as they come: whether they are as many as
/// the shape asks for, and finite, shows when the bytes are read again.
class PolicyWriter {
public:
  void add(const std::string& name, const TensorShape& shape, std::span<const float> numbers);

  /// Layers prefix + "fc1", "fc2", ...
  void add(const std::string& prefix, const MlpShape& shape, std::span<const float> parameters);

  std::string bytes(const std::map<std::string, std::string>& metadata) const;

private:
  void declare(const std::string& name, const TensorShape& shape);
  void append(std::span<const float> numbers);

  std::vector<sct::TensorToStore> tensors_;
  std::string data_;
};

}  // namespace folk::mpe
