#include <folk/tools/choices/standard_names.h>
#include <folk/tools/ipd_strategies/equilibria.h>
#include <folk/tools/program/csv.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/table.h>
#include <folk/tools/program/threads_option.h>

#include <folk/analysis/play/parallel.h>
#include <folk/analysis/thresholds/thresholds.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Larger machines are left out.
constexpr std::size_t most_states = 1024;

/// A strategy against its copy.
struct SelfPlay {
  std::string name;
  std::size_t states = 0;
  std::optional<Thresholds> thresholds{};  ///< nothing where it is no deterministic machine of at most most_states
};

SelfPlay self_play(const Strategy& strategy, const Payoffs& payoffs) {
  constexpr Sense any = Sense::any_own_moves;
  SelfPlay found{strategy.name};
  if (!strategy.machine || !strategy.machine->deterministic() || !strategy.machine->finite()) return found;
  const auto table = tabulate(*strategy.machine, any, most_states);
  if (!table) return found;
  const Automaton machine = minimise(*table, any);
  found.states = machine.size();
  found.thresholds = thresholds(machine, machine, payoffs);
  return found;
}

template <class Text>
auto sets_of(const Thresholds& found, Text text) {
  const auto one = [&](const std::optional<Threshold>& threshold) {
    return threshold ? std::optional(text(threshold->set)) : std::nullopt;
  };
  return std::array{one(found.nash), one(found.subgame_perfect), one(found.self_confirming_unrestricted)};
}

void print_text(const std::vector<SelfPlay>& all) {
  std::cout << "discount factors at which a strategy is in equilibrium with its copy\n\n";
  Table table({"strategy", "states", "Nash", "subgame perfect", "self-confirming"});
  std::vector<std::string> without;
  for (const SelfPlay& one : all) {
    if (!one.thresholds) {
      without.push_back(one.name);
      continue;
    }
    std::vector<std::string> row{one.name, std::to_string(one.states)};
    for (const auto& set : sets_of(*one.thresholds, [](const DiscountSet& s) { return to_readable_text(s); }))
      row.push_back(set.value_or("-"));
    table.add(std::move(row));
  }
  std::cout << table.text();
  if (!without.empty())
    std::cout << "\n"
              << visible_line(fmt::format("no deterministic machines of at most {} states: {}", most_states,
                                          fmt::join(without, ", ")));
}

void print_csv(const std::vector<SelfPlay>& all) {
  std::cout << "strategy,states,nash,subgame_perfect,self_confirming\n";
  for (const SelfPlay& one : all) {
    if (!one.thresholds) continue;
    std::cout << csv_field(one.name) << "," << one.states;
    for (const auto& set : sets_of(*one.thresholds, [](const DiscountSet& s) { return to_text(s); }))
      std::cout << "," << csv_field(set.value_or(""));
    std::cout << "\n";
  }
}

void print_json(const std::string& spec, const std::vector<SelfPlay>& all) {
  Json json{{"strategies", spec}, {"entrants", Json::array()}};
  for (const SelfPlay& one : all) {
    Json entry{{"name", one.name}, {"states", nullptr}, {"thresholds_exact", nullptr}};
    if (one.thresholds) {
      const auto sets = sets_of(*one.thresholds, [](const DiscountSet& s) { return to_exact_texts(s); });
      const auto json_of = [](const auto& set) { return set ? Json(*set) : Json(nullptr); };
      entry["states"] = one.states;
      entry["thresholds_exact"] = {{"nash", json_of(sets[0])},
                                   {"subgame_perfect", json_of(sets[1])},
                                   {"self_confirming_unrestricted", json_of(sets[2])}};
    }
    json["entrants"].push_back(std::move(entry));
  }
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace

int equilibria(const std::string& spec, const Payoffs& payoffs, const po::variables_map& values, const Common& common) {
  const auto strategies = standard_names().roster(spec, payoffs);
  std::vector<SelfPlay> all(strategies.size());
  {
    ProgressBar bar("looking for thresholds", !common.quiet);
    const auto answer = [&](std::size_t i, unsigned) { all[i] = self_play(strategies[i], payoffs); };
    parallel_for(strategies.size(), threads_option(values, common), answer, [&](double share) { bar(share); });
  }
  switch (common.format) {
    case Format::text: print_text(all); break;
    case Format::csv: print_csv(all); break;
    case Format::json: print_json(spec, all); break;
  }
  return done;
}

}  // namespace folk::tools
