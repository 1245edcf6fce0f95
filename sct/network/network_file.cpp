#include <folk/games/error.h>
#include <folk/sct/files/checksum.h>
#include <folk/sct/files/little_endian.h>
#include <folk/sct/network/network_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <set>

namespace folk::sct {
namespace {

constexpr std::size_t number_bytes = 4;  // F32

/// "return observation belief action", with ".0", ".1", ... when there are several agents.
std::string token_layout(const Architecture& architecture) {
  const auto each = [&](const char* token) {
    if (architecture.agents == 1) return fmt::format(" {}", token);
    std::string tokens;
    for (std::size_t i = 0; i < architecture.agents; ++i) tokens += fmt::format(" {}.{}", token, i);
    return tokens;
  };
  return "return" + each("observation") + (architecture.belief_token ? " belief" : "") + each("action");
}

/// What the numbers of an observation say: in a 2x2 game the last outcome, or some, one of five set to 1.
std::string observation_meaning(const Architecture& architecture) {
  constexpr std::size_t outcome_size = 5;
  const std::size_t remembered = architecture.observation_size / outcome_size;
  const bool outcomes = architecture.discrete && architecture.agents == 1 && architecture.action_size == 2 &&
                        architecture.observation_size == remembered * outcome_size;
  if (!outcomes) return "numbers";
  return remembered == 1 ? "start CC CD DC DD"
                         : fmt::format("start CC CD DC DD, of each of the last {} rounds", remembered);
}

const char* truth(bool value) { return value ? "true" : "false"; }

Readout parse_readout(const Metadata& metadata) {
  for (const auto readout : {Readout::token, Readout::cat, Readout::add, Readout::own})
    if (metadata.text("readout") == to_string(readout)) return readout;
  metadata.wrong("readout", "token, cat, add or own");
}

/// Throws UsageError unless the file has these tensors, each of this type, shape and number of bytes, and no other.
void check_tensors(const SafetensorsFile& file, const ParameterLayout& layout) {
  for (const Tensor& tensor : layout.tensors()) {
    const auto found = file.tensors.find(tensor.name);
    if (found == file.tensors.end())
      throw UsageError(fmt::format("lacks tensor '{}' of its architecture; take a fresh copy", tensor.name));
    const StoredTensor& stored = found->second;
    if (stored.dtype != "F32")
      throw UsageError(fmt::format("tensor '{}' has dtype {}; store it as F32", tensor.name, excerpt(stored.dtype)));
    if (!std::equal(stored.shape.begin(), stored.shape.end(), tensor.shape.begin(), tensor.shape.end()))
      throw UsageError(fmt::format("tensor '{}' has shape [{}], but the architecture asks for [{}]; take a fresh copy",
                                   tensor.name, fmt::join(stored.shape, ", "), fmt::join(tensor.shape, ", ")));
    if (stored.data.size() != tensor.size() * number_bytes)  // the sizes of a checked architecture fit
      throw UsageError(fmt::format("tensor '{}' has {} bytes, but its shape asks for {}; take a fresh copy",
                                   tensor.name, stored.data.size(), tensor.size() * number_bytes));
  }
  if (file.tensors.size() == layout.tensors().size()) return;
  std::set<std::string_view> known;
  for (const Tensor& tensor : layout.tensors()) known.insert(tensor.name);
  for (const auto& [name, stored] : file.tensors)
    if (!known.contains(name))
      throw UsageError(fmt::format("tensor '{}' is not of its architecture; take a fresh copy", excerpt(name)));
}

}  // namespace

const std::string& Metadata::text(const char* key) const {
  const auto found = texts_.find(key);
  if (found == texts_.end()) throw UsageError(fmt::format("metadata lacks '{}'", key));
  return found->second;
}

namespace {

template <class Number>
Number number(const Metadata& metadata, const char* key, const char* expected) {
  const std::string& digits = metadata.text(key);
  const char* end = digits.data() + digits.size();
  Number value{};
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc() || stop != end) metadata.wrong(key, expected);
  return value;
}

}  // namespace

template <std::unsigned_integral Number>
Number Metadata::whole(const char* key) const {
  return number<Number>(*this, key, "a whole number");
}
template std::uint64_t Metadata::whole<std::uint64_t>(const char*) const;

double Metadata::real(const char* key) const { return number<double>(*this, key, "a decimal number"); }

bool Metadata::boolean(const char* key) const {
  if (text(key) == "true") return true;
  if (text(key) == "false") return false;
  wrong(key, "true or false");
}

void Metadata::wrong(const char* key, std::string_view expected) const {
  throw UsageError(fmt::format("metadata '{}' is '{}': expected {}", key, excerpt(text(key)), expected));
}

Texts architecture_texts(const Architecture& a) {
  return {
      {"hidden", fmt::to_string(a.hidden)},
      {"layers", fmt::to_string(a.layers)},
      {"heads", fmt::to_string(a.heads)},
      {"context", fmt::to_string(a.context)},
      {"time_rows", fmt::to_string(a.time_rows)},
      {"observation_size", fmt::to_string(a.observation_size)},
      {"action_size", fmt::to_string(a.action_size)},
      {"agents", fmt::to_string(a.agents)},
      {"discrete", truth(a.discrete)},
      {"readout", std::string(to_string(a.readout))},
      {"belief_token", truth(a.belief_token)},
      {"auxiliary", truth(a.auxiliary)},
      {"token_layout", token_layout(a)},
      {"observation", observation_meaning(a)},
  };
}

Architecture parse_architecture(const Metadata& metadata) {
  Architecture a;
  a.hidden = metadata.whole<std::size_t>("hidden");
  a.layers = metadata.whole<std::size_t>("layers");
  a.heads = metadata.whole<std::size_t>("heads");
  a.context = metadata.whole<std::size_t>("context");
  a.time_rows = metadata.whole<std::size_t>("time_rows");
  a.observation_size = metadata.whole<std::size_t>("observation_size");
  a.action_size = metadata.whole<std::size_t>("action_size");
  a.agents = metadata.whole<std::size_t>("agents");
  a.discrete = metadata.boolean("discrete");
  a.readout = parse_readout(metadata);
  a.belief_token = metadata.boolean("belief_token");
  a.auxiliary = metadata.boolean("auxiliary");
  a.check();
  if (metadata.text("token_layout") != token_layout(a)) metadata.wrong("token_layout", token_layout(a));
  if (metadata.text("observation") != observation_meaning(a)) metadata.wrong("observation", observation_meaning(a));
  return a;
}

/// 16 hexadecimal digits over the metadata, key by key in the order of their bytes, and the parameters in the order of
/// ParameterLayout: what another program stores in another order is the same policy.
std::string checksum(const Texts& metadata, std::span<const float> parameters) {
  Checksum sum;
  for (const auto& [key, text] : metadata)
    if (key != checksum_key) {
      sum.add(key);
      sum.add(text);
    }
  for (const float number : parameters) sum.add(std::uint64_t{std::bit_cast<std::uint32_t>(number)});
  return fmt::format("{:016x}", sum.value());
}

void require_playable(std::span<const float> parameters, const ParameterLayout& layout) {
  if (parameters.size() != layout.size())
    throw UsageError(fmt::format("{} parameters: the architecture has {}", parameters.size(), layout.size()));
  for (const Tensor& tensor : layout.tensors()) {
    const auto first = parameters.begin() + static_cast<std::ptrdiff_t>(tensor.offset);
    const auto last = first + static_cast<std::ptrdiff_t>(tensor.size());
    const auto wrong = std::find_if(first, last, [](float number) { return !std::isfinite(number); });
    if (wrong != last)
      throw UsageError(fmt::format(
          "tensor '{}' holds {} at [{}], with which nothing can play; take another policy", tensor.name, *wrong,
          tensor.shape.size() == 1 ? fmt::to_string(wrong - first)
                                   : fmt::format("{}, {}", static_cast<std::size_t>(wrong - first) / tensor.columns(),
                                                 static_cast<std::size_t>(wrong - first) % tensor.columns())));
  }
}

std::vector<float> stored_parameters(const SafetensorsFile& file, const ParameterLayout& layout) {
  check_tensors(file, layout);
  std::vector<float> parameters;
  parameters.reserve(layout.size());
  for (const Tensor& tensor : layout.tensors()) {
    const std::string_view data = file.tensors.at(tensor.name).data;
    for (std::size_t i = 0; i < data.size(); i += number_bytes)
      parameters.push_back(std::bit_cast<float>(load_little_endian<std::uint32_t>(data.substr(i, number_bytes))));
  }
  return parameters;
}

std::string network_bytes(const Texts& metadata, std::span<const float> parameters, const ParameterLayout& layout) {
  std::vector<TensorToStore> tensors;
  for (const Tensor& tensor : layout.tensors())
    tensors.push_back({tensor.name, tensor.shape, tensor.size() * number_bytes});
  std::string bytes = safetensors_header(metadata, tensors);
  bytes.reserve(bytes.size() + layout.size() * number_bytes);
  for (const float number : parameters) append_little_endian(bytes, std::bit_cast<std::uint32_t>(number));
  return bytes;
}

}  // namespace folk::sct
