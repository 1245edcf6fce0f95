#pragma once
// Untrained small policies of 2x2 games with lively opinions, for tests of play.

#include <folk/sct/policy/thinker.h>
#include <sct/network/random_network.h>

#include <cstdint>
#include <memory>

namespace folk::test {

/// How a policy was trained, as far as play depends on it.
struct Training {
  const char* name;
  sct::LossMode mode = sct::LossMode::teacher;
  sct::Readout readout = sct::Readout::token;
  bool belief_token = true;
  std::size_t remembered = 1;
};

/// Every kind of policy that plays.
inline constexpr std::array trainings{
    Training{"teacher_token"},
    Training{"teacher_cat", sct::LossMode::teacher, sct::Readout::cat},
    Training{"teacher_add", sct::LossMode::teacher, sct::Readout::add},
    Training{"selfconf_token", sct::LossMode::selfconf},
    Training{"selfconf_cat", sct::LossMode::selfconf, sct::Readout::cat},
    Training{"remembers_three_rounds", sct::LossMode::teacher, sct::Readout::token, true, 3},
    Training{"rmadt", sct::LossMode::teacher, sct::Readout::own},
    Training{"madt", sct::LossMode::action_only, sct::Readout::own},
    Training{"madt_without_token", sct::LossMode::action_only, sct::Readout::own, false},
};

/// A policy for matches of 14 rounds with a context of 5.
inline sct::Policy playing_policy(const Training& training, std::uint64_t seed = 1) {
  sct::Policy policy;
  auto& a = policy.architecture;
  a.hidden = 12;
  a.layers = 2;
  a.heads = 2;
  a.context = 5;
  a.time_rows = 14;
  a.readout = training.readout;
  a.belief_token = training.belief_token;
  a.observation_size = training.remembered * sct::observation_size;
  Draw draw(seed);
  policy.parameters = random_parameters<float>(a, draw);
  policy.training.mode = training.mode;
  policy.training.data = "tournament";
  policy.training.rounds = 14;
  policy.training.criterion = "finite:14";
  policy.training.return_scale = 10;
  policy.training.return_target = 42;
  return policy;
}

inline std::shared_ptr<const sct::Mind> playing_mind(const Training& training = {}, std::uint64_t seed = 1) {
  return std::make_shared<const sct::Mind>(playing_policy(training, seed));
}

}  // namespace folk::test
