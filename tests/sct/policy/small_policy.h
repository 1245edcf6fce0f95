#pragma once
// Policies small enough to be written out, for tests of their files.

#include <folk/sct/policy/policy.h>

#include <cstddef>

namespace folk::test {

/// Fills the parameters with numbers that all differ.
inline sct::Policy with_parameters(sct::Policy policy) {
  const std::size_t size = sct::ParameterLayout(policy.architecture).size();
  policy.parameters.clear();
  for (std::size_t i = 0; i < size; ++i)
    policy.parameters.push_back((i % 2 == 0 ? 1.0F : -1.0F) * static_cast<float>(i + 1) / 64.0F);
  return policy;
}

/// The smallest policy of a 2x2 game; a copy of its file is tests/fuzz/corpus/policy/smallest.
inline sct::Policy small_policy() {
  sct::Policy policy;
  auto& a = policy.architecture;
  a.hidden = a.layers = a.context = 1;
  a.time_rows = 3;
  auto& t = policy.training;
  t.data = "tournament";
  t.roster = "classics";
  t.rounds = 3;
  t.criterion = "finite:3";
  t.return_target = 8.75;
  t.final_belief_loss = 0.1;
  t.code_version = "0.1.0";
  return with_parameters(policy);
}

/// One with everything that the small one has not: continuous actions of two agents, all heads.
inline sct::Policy continuous_policy() {
  sct::Policy policy = small_policy();
  auto& a = policy.architecture;
  a.hidden = 4;
  a.heads = 2;
  a.layers = 2;
  a.agents = 2;
  a.observation_size = 3;
  a.discrete = false;
  a.readout = sct::Readout::cat;
  a.auxiliary = true;
  policy.training.mode = sct::LossMode::composite;
  return with_parameters(policy);
}

}  // namespace folk::test
