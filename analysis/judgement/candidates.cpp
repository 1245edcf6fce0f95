#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/judgement/candidates.h>
#include <folk/analysis/play/pair_player.h>

#include <algorithm>

namespace folk {

std::string Candidates::Behaviour::names() const {
  std::string text;
  for (const auto& strategy : strategies) text += (text.empty() ? "" : " = ") + strategy.name;
  return text;
}

std::vector<double> Candidates::weights() const {
  std::vector<double> all;
  for (const auto& behaviour : behaviours) all.push_back(behaviour.weight);
  for (const auto& one : classes) all.push_back(one.weight);
  return all;
}

Candidates candidates_of(const OpponentPrior& prior, std::uint64_t rounds) {
  std::vector<Strategy> roster;
  for (const auto& known : prior.known) roster.push_back(known.strategy);
  Sampling rules;
  rules.criterion = Criterion::finite(std::max<std::uint64_t>(rounds, 1));
  rules.noise = 0.01;  // any: moves slip, so that all histories count
  const PairPlayer players(roster, rules, 1);
  Candidates candidates;
  candidates.behaviours.resize(players.behaviours().size());
  for (std::size_t i = 0; i < roster.size(); ++i) {
    auto& behaviour = candidates.behaviours[players.behaviour_of()[i]];
    behaviour.strategies.push_back(roster[i]);
    behaviour.weight += prior.known[i].weight;
  }
  candidates.classes = prior.classes;
  return candidates;
}

std::vector<std::string> leave_out_unpredictable(OpponentPrior& prior) {
  std::vector<std::string> names;
  std::erase_if(prior.known, [&](const OpponentPrior::Known& known) {
    const bool unpredictable = !known.strategy.machine && !is_deterministic(known.strategy);
    if (unpredictable) names.push_back(known.strategy.name);
    return unpredictable;
  });
  return names;
}

}  // namespace folk
