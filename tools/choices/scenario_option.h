#pragma once
// The options that choose a scenario of the particle world: --scenario and --reward-rule.

#include <folk/tools/program/program.h>

#include <folk/mpe/world/scenario.h>

namespace folk::tools {

/// Adds --scenario and --reward-rule.
void add_scenario_options(po::options_description& options);

/// The rule of --reward-rule. Throws UsageError.
mpe::RewardRule chosen_reward_rule(const po::variables_map& values);

/// The scenario of both options, simple_tag by default. Throws UsageError.
mpe::Scenario chosen_scenario(const po::variables_map& values);

}  // namespace folk::tools
