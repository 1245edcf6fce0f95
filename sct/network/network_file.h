#pragma once
// A network inside a safetensors file: its architecture as metadata, its parameters as tensors. What policies of
// repeated games and of the particle world have in common.

#include <folk/sct/files/safetensors.h>
#include <folk/sct/network/architecture.h>

#include <concepts>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace folk::sct {

using Texts = std::map<std::string, std::string>;

inline constexpr const char* checksum_key = "checksum";

/// The metadata as values. Throws UsageError with the key's name.
class Metadata {
public:
  /// `texts` must outlive this.
  explicit Metadata(const Texts& texts)
      : texts_(texts) {}

  const std::string& text(const char* key) const;
  template <std::unsigned_integral Number>
  Number whole(const char* key) const;
  double real(const char* key) const;
  bool boolean(const char* key) const;

  [[noreturn]] void wrong(const char* key, std::string_view expected) const;

private:
  const Texts& texts_;
};

/// What a file says of an architecture, and back. Throws UsageError for one that no network can have.
Texts architecture_texts(const Architecture& architecture);
Architecture parse_architecture(const Metadata& metadata);

/// 16 hexadecimal digits over the metadata (but for the checksum's own), key by key in the order of their bytes, and
/// the parameters in the order of ParameterLayout: what another program stores in another order is the same policy.
std::string checksum(const Texts& metadata, std::span<const float> parameters);

/// Throws UsageError unless there are as many parameters as the layout has, all finite.
void require_playable(std::span<const float> parameters, const ParameterLayout& layout);

/// The parameters in a file. Throws UsageError unless it has the layout's tensors, each of this type, shape and number
/// of bytes, and no other.
std::vector<float> stored_parameters(const SafetensorsFile& file, const ParameterLayout& layout);

/// The bytes of a file.
std::string network_bytes(const Texts& metadata, std::span<const float> parameters, const ParameterLayout& layout);

}  // namespace folk::sct
