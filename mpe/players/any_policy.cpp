#include <folk/games/error.h>
#include <folk/mpe/players/any_policy.h>
#include <folk/mpe/players/bcq_policy.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/players/transformer_player.h>
#include <folk/mpe/players/window_policy.h>
#include <folk/sct/files/safetensors.h>

#include <fmt/format.h>

#include <utility>

namespace folk::mpe {
namespace {

/// What the metadata call the format; empty where they do not.
std::string format_of(std::string_view bytes, const std::string& source) {
  const auto file = sct::parse_safetensors(bytes, source);
  const auto found = file.metadata.find("format");
  return found == file.metadata.end() ? std::string() : found->second;
}

void require_predators(const std::string& name, Side side) {
  if (side == Side::prey)
    throw UsageError(fmt::format("{}: a policy of the predators, not of the prey", excerpt(name, 1000)));
}

}  // namespace

Controller any_policy_controller(std::string name, std::string_view bytes, const std::string& source, Side side,
                                 const Scenario& scenario) {
  const std::string format = format_of(bytes, source);
  if (format == window_policy_format) {
    auto policy = parse_window_policy(bytes, source);
    require_predators(name, side);
    return window_controller(std::move(name), std::move(policy), scenario);
  }
  if (format == bcq_policy_format) {
    auto policy = parse_bcq_policy(bytes, source);
    require_predators(name, side);
    return bcq_controller(std::move(name), std::move(policy), scenario);
  }
  if (format == transformer_format) {
    auto mind = std::make_shared<const TransformerMind>(parse_transformer_policy(bytes, source));
    require_predators(name, side);
    return transformer_controller(std::move(name), std::move(mind), scenario);
  }
  return policy_controller(std::move(name), parse_policy(bytes, source), side, scenario);
}

bool is_transformer(std::string_view bytes, const std::string& source) {
  return format_of(bytes, source) == transformer_format;
}

}  // namespace folk::mpe
