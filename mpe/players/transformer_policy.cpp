#include <folk/games/error.h>
#include <folk/mpe/players/transformer_policy.h>
#include <folk/sct/network/network_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace folk::mpe {
namespace {

/// "0.25 -1 3": finite floats, of which there must be `count`.
std::vector<float> parse_numbers(const sct::Metadata& metadata, const char* key, std::size_t count) {
  const std::string& text = metadata.text(key);
  std::vector<float> numbers;
  const char* const end = text.data() + text.size();
  for (const char* begin = text.data();; ++begin) {  // over the blank between two
    float number = 0;
    const auto [stop, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || !std::isfinite(number)) break;
    numbers.push_back(number);
    begin = stop;
    if (begin == end && numbers.size() == count) return numbers;
    if (begin == end || *begin != ' ') break;
  }
  metadata.wrong(key, fmt::format("{} numbers", count));
}

sct::Texts metadata_of(const TransformerPolicy& policy) {
  sct::Texts texts = sct::architecture_texts(policy.architecture);
  texts.merge(sct::Texts{{"format", std::string(transformer_format)},
                         {"scenario", policy.scenario},
                         {"loss_mode", std::string(to_string(policy.mode))},
                         {"scale_mean", fmt::format("{}", fmt::join(policy.scale.mean, " "))},
                         {"scale_deviation", fmt::format("{}", fmt::join(policy.scale.deviation, " "))},
                         {"return_scale", fmt::format("{}", policy.return_scale)},
                         {"return_target", fmt::format("{}", policy.return_target)}});
  return texts;
}

double finite(const sct::Metadata& metadata, const char* key) {
  const double number = metadata.real(key);
  if (!std::isfinite(number)) metadata.wrong(key, "a finite number");
  return number;
}

TransformerPolicy policy_of(const sct::SafetensorsFile& file) {
  const sct::Metadata metadata(file.metadata);
  if (metadata.text("format") != transformer_format)
    throw UsageError(
        fmt::format("format '{}': this Folk reads {}", excerpt(metadata.text("format")), transformer_format));
  TransformerPolicy policy;
  policy.scenario = metadata.text("scenario");
  const Scenario scenario = Scenario::named(policy.scenario);
  policy.architecture = sct::parse_architecture(metadata);
  if (policy.architecture != particle_architecture(scenario, policy.architecture))
    throw UsageError(fmt::format("its stream is not that of {}; take a fresh copy", policy.scenario));
  policy.mode = sct::parse_loss_mode(metadata.text("loss_mode"));
  policy.scale.mean = parse_numbers(metadata, "scale_mean", scenario.predators());
  policy.scale.deviation = parse_numbers(metadata, "scale_deviation", scenario.predators());
  for (const float deviation : policy.scale.deviation)
    if (!(deviation > 0)) metadata.wrong("scale_deviation", "numbers above 0");
  policy.return_scale = finite(metadata, "return_scale");
  if (!(policy.return_scale > 0)) metadata.wrong("return_scale", "a number above 0");
  policy.return_target = finite(metadata, "return_target");
  if (!(std::abs(policy.return_target / policy.return_scale) <= double{std::numeric_limits<float>::max()}))
    metadata.wrong("return_target", "a return that, scaled, a network can be told");
  const sct::ParameterLayout layout(policy.architecture);
  policy.parameters = sct::stored_parameters(file, layout);
  sct::require_playable(policy.parameters, layout);
  if (const auto found = sct::checksum(file.metadata, policy.parameters); metadata.text(sct::checksum_key) != found)
    throw UsageError(fmt::format("checksum {} instead of {}: the contents were changed; take a fresh copy", found,
                                 excerpt(metadata.text(sct::checksum_key))));
  const auto known = metadata_of(policy);
  for (const auto& [key, text] : file.metadata)
    if (!known.contains(key) && key != sct::checksum_key) policy.notes.emplace(key, text);
  return policy;
}

}  // namespace

sct::Architecture particle_architecture(const Scenario& scenario, sct::Architecture base) {
  base.agents = scenario.predators();
  base.observation_size = scenario.observation_size(0);
  base.action_size = 2;
  base.discrete = false;
  base.time_rows = scenario.episode_steps + 1;
  return base;
}

TransformerPolicy parse_transformer_policy(std::string_view bytes, const std::string& source) {
  const sct::SafetensorsFile file = sct::parse_safetensors(bytes, source);
  try {
    return policy_of(file);
  } catch (const UsageError& error) {
    throw InputFileError(fmt::format("{}: {}", excerpt(source, 1000), error.what()));
  }
}

std::string transformer_policy_bytes(const TransformerPolicy& policy) {
  const sct::ParameterLayout layout(policy.architecture);
  sct::require_playable(policy.parameters, layout);
  sct::Texts metadata = metadata_of(policy);
  metadata.insert(policy.notes.begin(), policy.notes.end());
  metadata[sct::checksum_key] = sct::checksum(metadata, policy.parameters);
  std::string bytes = sct::network_bytes(metadata, policy.parameters, layout);
  try {
    parse_transformer_policy(bytes, "policy");
  } catch (const InputFileError& error) {
    throw UsageError(fmt::format("a policy that could not be read again: {}", error.what()));
  }
  return bytes;
}

}  // namespace folk::mpe
