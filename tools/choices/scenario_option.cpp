#include <folk/tools/choices/scenario_option.h>

#include <fmt/format.h>
#include <folk/games/error.h>

namespace folk::tools {

void add_scenario_options(po::options_description& options) {
  auto add = options.add_options();
  add("scenario", po::value<std::string>(), "simple_tag (default) or simple_world");
  add("reward-rule", po::value<std::string>(),
      "program (default): distances always, catches on top; paper: catches where there are any, otherwise distances");
}

mpe::RewardRule chosen_reward_rule(const po::variables_map& values) {
  const auto rule = text_option(values, "reward-rule", "program");
  if (rule != "program" && rule != "paper")
    throw UsageError(fmt::format("--reward-rule '{}': expected program or paper", excerpt(rule)));
  return rule == "program" ? mpe::RewardRule::program : mpe::RewardRule::paper;
}

mpe::Scenario chosen_scenario(const po::variables_map& values) {
  return mpe::Scenario::named(text_option(values, "scenario", "simple_tag"), chosen_reward_rule(values));
}

}  // namespace folk::tools
