#include <folk/analysis/signature.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/sct/little_endian.h>
#include <folk/sct/policy_file.h>
#include <folk/sct/safetensors.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <vector>

namespace folk::sct {

namespace {

using Texts = std::map<std::string, std::string>;

constexpr std::string_view format_family = "folk-sct-";
constexpr const char* checksum_key = "checksum";
constexpr std::size_t number_bytes = 4;  // F32
constexpr std::size_t most_action_names = 1024;
constexpr std::size_t longest_action_names = 65536;  // bytes of their JSON text

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

/// What the numbers of an observation say: in a 2x2 game the last outcome, one of five set to 1.
std::string observation_meaning(const Architecture& architecture) {
  const bool outcomes = architecture.discrete && architecture.agents == 1 && architecture.action_size == 2 &&
                        architecture.observation_size == 5;
  return outcomes ? "start CC CD DC DD" : "numbers";
}

const char* truth(bool value) { return value ? "true" : "false"; }

/// Any text as UTF-8.
std::string utf8(const std::string& text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

/// Everything that a file says of a policy besides its tensors, except the checksum.
Texts metadata_of(const Policy& policy) {
  const Architecture& a = policy.architecture;
  const TrainingRecord& t = policy.training;
  std::vector<std::string> names;
  for (const std::string& name : policy.action_names) names.push_back(utf8(name));
  return {
      {"format", std::string(policy_format)},
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
      {"action_names", nlohmann::json(names).dump()},
      {"loss_mode", std::string(to_string(t.mode))},
      {"data", utf8(t.data)},
      {"roster", utf8(t.roster)},
      {"payoffs", to_text(t.payoffs)},
      {"rounds", fmt::to_string(t.rounds)},
      {"criterion", utf8(t.criterion)},
      {"return_scale", fmt::format("{}", t.return_scale)},
      {"return_target", fmt::format("{}", t.return_target)},
      {"seed", fmt::to_string(t.seed)},
      {"steps", fmt::to_string(t.steps)},
      {"final_belief_loss", fmt::format("{}", t.final_belief_loss)},
      {"final_action_loss", fmt::format("{}", t.final_action_loss)},
      {"code_version", utf8(t.code_version)},
  };
}

/// 16 hexadecimal digits over the metadata, key by key in the order of their bytes, and the parameters in the order of
/// ParameterLayout: what another program stores in another order is the same policy.
std::string checksum(const Texts& metadata, std::span<const float> parameters) {
  Signature signature;
  for (const auto& [key, text] : metadata)
    if (key != checksum_key) {
      signature.add(key);
      signature.add(text);
    }
  for (const float number : parameters) signature.add(std::uint64_t{std::bit_cast<std::uint32_t>(number)});
  return fmt::format("{:016x}", signature.value());
}

/// Throws UsageError for numbers and names that no policy can have.
void check(const Policy& policy, const ParameterLayout& layout) {
  if (policy.parameters.size() != layout.size())
    throw UsageError(fmt::format("{} parameters: the architecture has {}", policy.parameters.size(), layout.size()));
  for (const Tensor& tensor : layout.tensors()) {
    const auto first = policy.parameters.begin() + static_cast<std::ptrdiff_t>(tensor.offset);
    const auto last = first + static_cast<std::ptrdiff_t>(tensor.size());
    const auto wrong = std::find_if(first, last, [](float number) { return !std::isfinite(number); });
    if (wrong != last)
      throw UsageError(fmt::format(
          "tensor '{}' holds {} at [{}], with which nothing can play; take another policy", tensor.name, *wrong,
          tensor.shape.size() == 1 ? fmt::to_string(wrong - first)
                                   : fmt::format("{}, {}", static_cast<std::size_t>(wrong - first) / tensor.columns(),
                                                 static_cast<std::size_t>(wrong - first) % tensor.columns())));
  }

  const auto& names = policy.action_names;
  const std::size_t actions = policy.architecture.action_size;
  if (policy.architecture.discrete && names.size() != actions)
    throw UsageError(fmt::format("{} action_names: the architecture has {} actions", names.size(), actions));
  if (nlohmann::json(names).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).size() >
      longest_action_names)
    throw UsageError(fmt::format("action_names: longer than {} bytes in all", longest_action_names));
  if (names.size() > most_action_names || std::set(names.begin(), names.end()).size() != names.size())
    throw UsageError(fmt::format("action_names: expected at most {} different names", most_action_names));

  const TrainingRecord& t = policy.training;
  const auto finite = [](double number, const char* what) {
    if (!std::isfinite(number)) throw UsageError(fmt::format("{} = {}: expected a finite number", what, number));
  };
  finite(t.return_scale, "return_scale");
  if (t.return_scale <= 0) throw UsageError(fmt::format("return_scale = {}: expected more than 0", t.return_scale));
  finite(t.return_target, "return_target");
  finite(t.final_belief_loss, "final_belief_loss");
  finite(t.final_action_loss, "final_action_loss");
  if (t.rounds < 1 || t.rounds > Criterion::most_rounds)
    throw UsageError(fmt::format("rounds = {}: expected 1 to {}", t.rounds, Criterion::most_rounds));
  Criterion::parse(t.criterion);
}

/// The metadata as values. Throws UsageError with the key's name.
class Metadata {
public:
  explicit Metadata(const Texts& texts)
      : texts_(texts) {}

  const std::string& text(const char* key) const {
    const auto found = texts_.find(key);
    if (found == texts_.end()) throw UsageError(fmt::format("metadata lacks '{}'", key));
    return found->second;
  }

  template <std::unsigned_integral Number>
  Number whole(const char* key) const {
    return number<Number>(key, "a whole number");
  }

  double real(const char* key) const { return number<double>(key, "a decimal number"); }

  bool boolean(const char* key) const {
    if (text(key) == "true") return true;
    if (text(key) == "false") return false;
    wrong(key, "true or false");
  }

  [[noreturn]] void wrong(const char* key, std::string_view expected) const {
    throw UsageError(fmt::format("metadata '{}' is '{}': expected {}", key, excerpt(text(key)), expected));
  }

private:
  template <class Number>
  Number number(const char* key, const char* expected) const {
    const std::string& digits = text(key);
    const char* end = digits.data() + digits.size();
    Number value{};
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (error != std::errc() || stop != end) wrong(key, expected);
    return value;
  }

  const Texts& texts_;
};

Readout parse_readout(const Metadata& metadata) {
  for (const auto readout : {Readout::token, Readout::cat, Readout::add, Readout::own})
    if (metadata.text("readout") == to_string(readout)) return readout;
  metadata.wrong("readout", "token, cat, add or own");
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

/// "T=5,R=3,P=1,S=0" in this order: of any symmetric 2x2 game, where parse_payoffs wants a prisoner's dilemma.
Payoffs parse_game(const Metadata& metadata) {
  Payoffs payoffs;
  std::string_view rest = metadata.text("payoffs");
  const auto next = [&](char letter) {
    const auto part = rest.substr(0, rest.find(','));
    if (part.size() < 2 || part[0] != letter || part[1] != '=') metadata.wrong("payoffs", "as in 'T=5,R=3,P=1,S=0'");
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    return parse_rational(part.substr(2));
  };
  payoffs.temptation = next('T');
  payoffs.reward = next('R');
  payoffs.punishment = next('P');
  payoffs.sucker = next('S');
  if (!rest.empty()) metadata.wrong("payoffs", "as in 'T=5,R=3,P=1,S=0'");
  return payoffs;
}

std::vector<std::string> parse_action_names(const Metadata& metadata) {
  const char* key = "action_names";
  if (metadata.text(key).size() > longest_action_names) metadata.wrong(key, "a shorter list");
  const auto names = nlohmann::json::parse(metadata.text(key), nullptr, false);
  const auto is_text = [](const nlohmann::json& name) { return name.is_string(); };
  if (!names.is_array() || !std::all_of(names.begin(), names.end(), is_text))
    metadata.wrong(key, R"(a JSON list of texts, as in ["C","D"])");
  return names.get<std::vector<std::string>>();
}

TrainingRecord parse_training(const Metadata& metadata) {
  TrainingRecord t;
  t.mode = parse_loss_mode(metadata.text("loss_mode"));
  t.data = metadata.text("data");
  t.roster = metadata.text("roster");
  t.payoffs = parse_game(metadata);
  t.rounds = metadata.whole<std::uint64_t>("rounds");
  t.criterion = metadata.text("criterion");
  t.return_scale = metadata.real("return_scale");
  t.return_target = metadata.real("return_target");
  t.seed = metadata.whole<std::uint64_t>("seed");
  t.steps = metadata.whole<std::uint64_t>("steps");
  t.final_belief_loss = metadata.real("final_belief_loss");
  t.final_action_loss = metadata.real("final_action_loss");
  t.code_version = metadata.text("code_version");
  return t;
}

/// Throws UsageError unless the file calls itself a policy of Folk in the format that is read here.
void check_format(const Texts& metadata) {
  const auto found = metadata.find("format");
  if (found == metadata.end() || !found->second.starts_with(format_family))
    throw UsageError("a safetensors file, but no policy of Folk; name one that sct-train wrote");
  if (found->second != policy_format)
    throw UsageError(fmt::format("a policy in format '{}', but this Folk reads {}; use the Folk that wrote it",
                                 excerpt(found->second), policy_format));
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

std::vector<float> parameters_of(const SafetensorsFile& file, const ParameterLayout& layout) {
  std::vector<float> parameters;
  parameters.reserve(layout.size());
  for (const Tensor& tensor : layout.tensors()) {
    const std::string_view data = file.tensors.at(tensor.name).data;
    for (std::size_t i = 0; i < data.size(); i += number_bytes)
      parameters.push_back(std::bit_cast<float>(load_little_endian<std::uint32_t>(data.substr(i, number_bytes))));
  }
  return parameters;
}

Policy policy_of(const SafetensorsFile& file) {
  check_format(file.metadata);
  const Metadata metadata(file.metadata);
  Policy policy;
  policy.architecture = parse_architecture(metadata);
  const ParameterLayout layout(policy.architecture);
  check_tensors(file, layout);
  policy.parameters = parameters_of(file, layout);
  policy.action_names = parse_action_names(metadata);
  policy.training = parse_training(metadata);
  check(policy, layout);
  const std::string found = checksum(file.metadata, policy.parameters);
  if (metadata.text(checksum_key) != found)
    throw UsageError(fmt::format("checksum {} instead of {}: the contents were changed; take a fresh copy", found,
                                 excerpt(metadata.text(checksum_key))));
  return policy;
}

}  // namespace

Policy parse_policy(std::string_view bytes, const std::string& source) {
  const SafetensorsFile file = parse_safetensors(bytes, source);
  try {
    return policy_of(file);
  } catch (const UsageError& error) {
    throw InputFileError(fmt::format("{}: {}", excerpt(source, 1000), error.what()));
  }
}

Policy read_policy(const std::filesystem::path& path) {
  return parse_policy(read_file(path, largest_policy_file), path.string());
}

std::string policy_bytes(const Policy& policy) {
  const ParameterLayout layout(policy.architecture);
  check(policy, layout);
  Texts metadata = metadata_of(policy);
  metadata[checksum_key] = checksum(metadata, policy.parameters);
  std::vector<TensorToStore> tensors;
  for (const Tensor& tensor : layout.tensors())
    tensors.push_back({tensor.name, tensor.shape, tensor.size() * number_bytes});
  std::string bytes = safetensors_header(metadata, tensors);
  bytes.reserve(bytes.size() + layout.size() * number_bytes);
  for (const float number : policy.parameters) append_little_endian(bytes, std::bit_cast<std::uint32_t>(number));
  if (bytes.size() > largest_policy_file)
    throw UsageError(fmt::format("a policy of {} bytes is larger than its file may be, {} MiB; make it smaller",
                                 bytes.size(), largest_policy_file >> 20U));
  return bytes;
}

void write_policy(const std::filesystem::path& path, const Policy& policy) { write_file(path, policy_bytes(policy)); }

}  // namespace folk::sct
