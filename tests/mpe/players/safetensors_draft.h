#pragma once
// A safetensors file by its parts, to be changed and put together again.

#include <folk/sct/files/safetensors.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace folk::mpe::testing {

struct SafetensorsDraft {
  struct Tensor {
    std::string dtype = "F32";
    std::vector<std::uint64_t> shape;
    std::string data;
  };
  std::map<std::string, std::string> metadata;
  std::map<std::string, Tensor> tensors;

  /// Throws what parse_safetensors throws.
  static SafetensorsDraft of(std::string_view bytes) {
    const auto file = sct::parse_safetensors(bytes, "draft");
    SafetensorsDraft draft{file.metadata, {}};
    for (const auto& [name, tensor] : file.tensors)
      draft.tensors[name] = {tensor.dtype, tensor.shape, std::string(tensor.data)};
    return draft;
  }

  std::string bytes() const {
    nlohmann::json header;
    header["__metadata__"] = metadata;
    std::string data;
    for (const auto& [name, tensor] : tensors) {
      header[name] = {{"dtype", tensor.dtype},
                      {"shape", tensor.shape},
                      {"data_offsets", {data.size(), data.size() + tensor.data.size()}}};
      data += tensor.data;
    }
    const std::string text = header.dump();
    std::string length(8, '\0');
    const std::uint64_t size = text.size();
    std::memcpy(length.data(), &size, sizeof size);
    return length + text + data;
  }

  /// A tensor with one value throughout.
  void put(const std::string& name, std::vector<std::uint64_t> shape, float value = 0.5F) {
    std::size_t count = 1;
    for (const auto side : shape) count *= side;
    std::string data;
    for (std::size_t i = 0; i < count; ++i) data.append(reinterpret_cast<const char*>(&value), sizeof value);
    tensors[name] = {"F32", std::move(shape), std::move(data)};
  }

  void set_number(const std::string& name, std::size_t at, float value) {
    std::memcpy(tensors.at(name).data.data() + at * sizeof value, &value, sizeof value);
  }
};

}  // namespace folk::mpe::testing
