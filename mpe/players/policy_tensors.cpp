#include <folk/games/error.h>
#include <folk/mpe/players/policy_tensors.h>
#include <folk/sct/files/little_endian.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

namespace folk::mpe {
namespace {

constexpr std::size_t most_layers = 16;
constexpr std::size_t widest_layer = 4096;

std::string layer_name(const std::string& prefix, std::size_t layer, const char* part) {
  return fmt::format("{}fc{}.{}", prefix, layer, part);
}

}  // namespace

PolicyReader::PolicyReader(std::string_view bytes, std::string source)
    : source_(std::move(source)),
      file_(sct::parse_safetensors(bytes, source_)) {}

void PolicyReader::refuse(const std::string& why) const { refuse_file(source_, why); }

std::string PolicyReader::take_word(const std::string& key) {
  const auto found = file_.metadata.find(key);
  if (found == file_.metadata.end()) refuse(fmt::format("metadata '{}' is missing", key));
  std::string value = std::move(found->second);
  file_.metadata.erase(found);
  return value;
}

const TensorShape& PolicyReader::shape(const std::string& tensor) const {
  const auto found = file_.tensors.find(tensor);
  if (found == file_.tensors.end()) refuse(fmt::format("tensor '{}' is missing; it is no policy of this form", tensor));
  return found->second.shape;
}

std::vector<float> PolicyReader::take(const std::string& name, const TensorShape& wanted) {
  const TensorShape& there = shape(name);
  if (there != wanted)
    refuse(fmt::format("tensor '{}' has shape ({}): expected ({})", name, fmt::join(there, ", "),
                       fmt::join(wanted, ", ")));
  const auto& tensor = file_.tensors.at(name);
  if (tensor.dtype != "F32")
    refuse(fmt::format("tensor '{}' has type {}: expected F32; convert it", name, excerpt(tensor.dtype)));
  std::uint64_t count = 1;
  for (const auto size : wanted) count *= size;
  if (tensor.data.size() != count * sizeof(float))
    refuse(fmt::format("tensor '{}' has {} bytes: expected {}", name, tensor.data.size(), count * sizeof(float)));
  std::vector<float> numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    numbers[i] = std::bit_cast<float>(sct::load_little_endian<std::uint32_t>(tensor.data.substr(i * sizeof(float))));
    if (!std::isfinite(numbers[i])) refuse(fmt::format("tensor '{}' holds a number that is not finite", name));
  }
  file_.tensors.erase(name);
  return numbers;
}

void PolicyReader::require_nothing_left() const {
  if (!file_.tensors.empty())
    refuse(fmt::format("tensor '{}' has no place in a policy", excerpt(file_.tensors.begin()->first)));
}

StoredNetwork take_stored_network(PolicyReader& reader, const std::string& prefix) {
  std::vector<std::size_t> widths;
  std::size_t layers = 0;
  while (layers == 0 || reader.has(layer_name(prefix, layers + 1, "weight"))) {
    ++layers;
    const std::string name = layer_name(prefix, layers, "weight");
    const TensorShape& shape = reader.shape(name);
    if (layers > most_layers) reader.refuse(fmt::format("more than {} layers", most_layers));
    if (shape.size() != 2 || shape[0] == 0 || shape[1] == 0 || shape[0] > widest_layer || shape[1] > widest_layer ||
        (!widths.empty() && shape[1] != widths.back()))
      reader.refuse(fmt::format("tensor '{}' has shape ({}), which does not follow the layer before", name,
                                fmt::join(shape, ", ")));
    if (widths.empty()) widths.push_back(shape[1]);
    widths.push_back(shape[0]);
  }
  StoredNetwork network{MlpShape(widths), {}};
  // Weight and bias of each layer follow each other in memory; only what the file really has is asked memory for.
  for (std::size_t layer = 1; layer <= layers; ++layer)
    for (const auto& [part, shape] : {std::pair<const char*, TensorShape>{"weight", {widths[layer], widths[layer - 1]}},
                                      std::pair<const char*, TensorShape>{"bias", {widths[layer]}}}) {
      const auto numbers = reader.take(layer_name(prefix, layer, part), shape);
      network.parameters.insert(network.parameters.end(), numbers.begin(), numbers.end());
    }
  return network;
}

PolicyNetwork take_network(PolicyReader& reader, const std::string& prefix) {
  StoredNetwork stored = take_stored_network(reader, prefix);
  if (stored.shape.outputs() != 2)
    reader.refuse(fmt::format("a network of {} outputs: expected 2, an action", stored.shape.outputs()));
  PolicyNetwork network;
  network.shape = std::move(stored.shape);
  network.parameters = std::move(stored.parameters);
  return network;
}

void PolicyWriter::add(const std::string& name, const TensorShape& shape, std::span<const float> numbers) {
  declare(name, shape);
  append(numbers);
}

void PolicyWriter::add(const std::string& prefix, const MlpShape& shape, std::span<const float> parameters) {
  const auto& widths = shape.widths();
  for (std::size_t layer = 1; layer <= shape.layers(); ++layer) {
    declare(layer_name(prefix, layer, "weight"), {widths[layer], widths[layer - 1]});
    declare(layer_name(prefix, layer, "bias"), {widths[layer]});
  }
  append(parameters);  // weight and bias of each layer follow each other there too
}

void PolicyWriter::declare(const std::string& name, const TensorShape& shape) {
  std::size_t bytes = sizeof(float);
  for (const auto size : shape) bytes *= size;
  tensors_.push_back({name, shape, bytes});
}

void PolicyWriter::append(std::span<const float> numbers) {
  for (const float number : numbers) sct::append_little_endian(data_, std::bit_cast<std::uint32_t>(number));
}

std::string PolicyWriter::bytes(const std::map<std::string, std::string>& metadata) const {
  return sct::safetensors_header(metadata, tensors_) + data_;
}

}  // namespace folk::mpe
