#pragma once
// Untrained small transformers of the particle world with lively opinions, for tests of play.

#include <folk/mpe/players/transformer_thinker.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "sct/network/random_network.h"

namespace folk::mpe::testing {

/// How a transformer was trained, as far as play depends on it.
struct TransformerKind {
  const char* name;
  sct::LossMode mode = sct::LossMode::teacher;
  sct::Readout readout = sct::Readout::cat;
  bool belief_token = true;
};

/// Every kind that plays.
inline constexpr std::array transformer_kinds{
    TransformerKind{"teacher_cat"},
    TransformerKind{"teacher_add", sct::LossMode::teacher, sct::Readout::add},
    TransformerKind{"teacher_token", sct::LossMode::teacher, sct::Readout::token},
    TransformerKind{"teacher_own", sct::LossMode::teacher, sct::Readout::own},
    TransformerKind{"teacher_own_without_token", sct::LossMode::teacher, sct::Readout::own, false},
    TransformerKind{"selfconf_cat", sct::LossMode::selfconf},
    TransformerKind{"selfconf_add", sct::LossMode::selfconf, sct::Readout::add},
    TransformerKind{"selfconf_token", sct::LossMode::selfconf, sct::Readout::token},
    TransformerKind{"selfconf_own", sct::LossMode::selfconf, sct::Readout::own},
    TransformerKind{"composite_cat", sct::LossMode::composite},
    TransformerKind{"madt", sct::LossMode::action_only, sct::Readout::own},
    TransformerKind{"madt_without_token", sct::LossMode::action_only, sct::Readout::own, false},
};

struct TransformerSizes {
  std::size_t context = 20;
  std::size_t hidden = 16;
  std::size_t layers = 2;
  std::size_t heads = 2;
};

inline TransformerPolicy small_transformer(const TransformerKind& kind = {"teacher_cat"},
                                           const std::string& scenario = "simple_tag", TransformerSizes sizes = {},
                                           std::uint64_t seed = 1) {
  TransformerPolicy policy;
  policy.scenario = scenario;
  sct::Architecture architecture;
  architecture.hidden = sizes.hidden;
  architecture.layers = sizes.layers;
  architecture.heads = sizes.heads;
  architecture.context = sizes.context;
  architecture.readout = kind.readout;
  architecture.belief_token = kind.belief_token;
  policy.architecture = particle_architecture(Scenario::named(scenario), architecture);
  policy.mode = kind.mode;
  folk::test::Draw draw(seed);
  policy.parameters = folk::test::random_parameters<float>(policy.architecture, draw);
  const sct::ParameterLayout layout(policy.architecture);
  for (const auto& tensor : layout.tensors())
    if (tensor.name.starts_with("predict_"))  // few answers at the ends of [-1, 1]
      for (std::size_t i = tensor.offset; i < tensor.offset + tensor.size(); ++i) policy.parameters[i] *= 0.4F;
  policy.scale = {{0.1F, -0.2F, 0.05F}, {0.9F, 1.1F, 1.3F}};
  policy.return_scale = 10;
  policy.return_target = 12.5;
  policy.notes = {{"made by", "a test"}};
  return policy;
}

inline std::shared_ptr<const TransformerMind> small_mind(const TransformerKind& kind = {"teacher_cat"},
                                                         const std::string& scenario = "simple_tag",
                                                         TransformerSizes sizes = {}, std::uint64_t seed = 1) {
  return std::make_shared<const TransformerMind>(small_transformer(kind, scenario, sizes, seed));
}

/// A policy of zeros: its beliefs and actions are 0, whatever it sees.
inline TransformerPolicy zero_transformer(const TransformerKind& kind = {"teacher_cat"},
                                          const std::string& scenario = "simple_tag") {
  auto policy = small_transformer(kind, scenario);
  policy.parameters.assign(policy.parameters.size(), 0.0F);
  return policy;
}

}  // namespace folk::mpe::testing
