#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/sct/files/little_endian.h>
#include <folk/sct/files/safetensors.h>
#include <folk/sct/network/network_file.h>
#include <folk/sct/policy/policy_file.h>

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

constexpr std::string_view format_family = "folk-sct-";
constexpr std::size_t most_action_names = 1024;
constexpr std::size_t longest_action_names = 65536;  // bytes of their JSON text

/// Any text as UTF-8.
std::string utf8(const std::string& text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

/// Everything that a file says of a policy besides its tensors, except the checksum.
Texts metadata_of(const Policy& policy) {
  const TrainingRecord& t = policy.training;
  std::vector<std::string> names;
  for (const std::string& name : policy.action_names) names.push_back(utf8(name));
  Texts texts{
      {"format", std::string(t.plan_depth > 0 || !t.shows_return ? planning_policy_format : policy_format)},
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
  if (texts["format"] == planning_policy_format) {
    texts["return_token"] = t.shows_return ? "shown" : "hidden";
    texts["plan_depth"] = fmt::to_string(t.plan_depth);
  }
  texts.merge(architecture_texts(policy.architecture));
  return texts;
}

/// Throws UsageError for numbers and names that no policy can have.
void check(const Policy& policy, const ParameterLayout& layout) {
  require_playable(policy.parameters, layout);

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
  if (t.plan_depth > most_plan_depth)
    throw UsageError(fmt::format("plan_depth = {}: expected at most {}", t.plan_depth, most_plan_depth));
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
  if (metadata.text("format") == planning_policy_format) {
    const auto& token = metadata.text("return_token");
    if (token != "shown" && token != "hidden") metadata.wrong("return_token", "shown or hidden");
    t.shows_return = token == "shown";
    t.plan_depth = static_cast<unsigned>(
        std::min<std::uint64_t>(metadata.whole<std::uint64_t>("plan_depth"), most_plan_depth + 1));
    if (t.shows_return && t.plan_depth == 0)
      metadata.wrong("format", fmt::format("{} of such a policy", policy_format));
  }
  return t;
}

/// Throws UsageError unless the file calls itself a policy of Folk in the format that is read here.
void check_format(const Texts& metadata) {
  const auto found = metadata.find("format");
  if (found == metadata.end() || !found->second.starts_with(format_family))
    throw UsageError("a safetensors file, but no policy of Folk; name one that sct-train wrote");
  if (found->second != policy_format && found->second != planning_policy_format)
    throw UsageError(fmt::format("a policy in format '{}', but this Folk reads {} and {}; use the Folk that wrote it",
                                 excerpt(found->second), policy_format, planning_policy_format));
}

/// The first key that another program has put beside those of a policy, where the checksum is right but for such keys;
/// empty otherwise.
std::string added_key(const Texts& metadata, const Policy& policy) {
  Texts own = metadata_of(policy);
  for (auto& [key, text] : own) text = metadata.at(key);
  if (checksum(own, policy.parameters) != metadata.at(checksum_key)) return {};
  for (const auto& [key, text] : metadata)
    if (key != checksum_key && !own.contains(key)) return key;
  return {};
}

/// The checksum covers all keys, those that are read over too. Throws UsageError.
void check_checksum(const Texts& metadata, const Policy& policy) {
  const std::string& stated = Metadata(metadata).text(checksum_key);
  const std::string found = checksum(metadata, policy.parameters);
  if (stated == found) return;
  const std::string added = added_key(metadata, policy);
  throw UsageError(fmt::format(
      "checksum {} instead of {}: {}", found, excerpt(stated),
      added.empty() ? "the contents were changed; take a fresh copy"
                    : fmt::format("metadata '{}' was added; take it out or write the new checksum", excerpt(added))));
}

Policy policy_of(const SafetensorsFile& file) {
  check_format(file.metadata);
  const Metadata metadata(file.metadata);
  Policy policy;
  policy.architecture = parse_architecture(metadata);
  const ParameterLayout layout(policy.architecture);
  policy.parameters = stored_parameters(file, layout);
  policy.action_names = parse_action_names(metadata);
  policy.training = parse_training(metadata);
  check(policy, layout);
  check_checksum(file.metadata, policy);
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
  std::string bytes = network_bytes(metadata, policy.parameters, layout);
  if (bytes.size() > largest_policy_file)
    throw UsageError(fmt::format("a policy of {} bytes is larger than its file may be, {} MiB; make it smaller",
                                 bytes.size(), largest_policy_file >> 20U));
  return bytes;
}

void write_policy(const std::filesystem::path& path, const Policy& policy) { write_file(path, policy_bytes(policy)); }

}  // namespace folk::sct
