#include <folk/tools/choices/standard_names.h>
#include <folk/tools/ipd_strategies/difference.h>
#include <folk/tools/ipd_strategies/same.h>
#include <folk/tools/program/csv.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

template <class Places>
Names names_of(const std::vector<Strategy>& strategies, const Places& places) {
  Names names;
  for (const std::size_t i : places) names.push_back(strategies[i].name);
  return names;
}

Names pair_of(const std::vector<Strategy>& strategies, const std::pair<std::size_t, std::size_t>& pair) {
  return {strategies[pair.first].name, strategies[pair.second].name};
}

void print_text(const std::vector<Strategy>& strategies, Sense sense, const SameStrategies& found) {
  std::cout << fmt::format("proved to be one strategy ({}); {} strategies\n\n", sense_text(sense), strategies.size());
  for (const auto& group : found.groups)
    std::cout << visible_line(fmt::format("{}", fmt::join(names_of(strategies, group), ", ")));
  if (found.groups.empty()) std::cout << "none\n";
  if (!found.undecided.empty()) std::cout << "\nnot told apart by any play that was tried\n\n";
  for (const auto& pair : found.undecided)
    std::cout << visible_line(fmt::format("{}", fmt::join(pair_of(strategies, pair), ", ")));
  if (!found.opaque.empty())
    std::cout << "\n"
              << visible_line(fmt::format("players, of whom nothing can be proved: {}",
                                          fmt::join(names_of(strategies, found.opaque), ", ")));
}

void print_csv(const std::vector<Strategy>& strategies, const SameStrategies& found) {
  std::cout << "group,result,strategy\n";
  std::size_t group = 0;
  const auto print = [&](const char* result, const Names& names) {
    ++group;
    for (const auto& name : names) std::cout << fmt::format("{},{},{}\n", group, result, csv_field(name));
  };
  for (const auto& places : found.groups) print("equivalent", names_of(strategies, places));
  for (const auto& pair : found.undecided) print("undecided", pair_of(strategies, pair));
}

}  // namespace

Json same_json(const std::string& spec, const std::vector<Strategy>& strategies, Sense sense,
               const SameStrategies& found) {
  Json json{{"strategies", spec}, {"sense", sense_key(sense)}, {"groups", Json::array()}, {"undecided", Json::array()}};
  for (const auto& group : found.groups) json["groups"].push_back(names_of(strategies, group));
  for (const auto& pair : found.undecided) json["undecided"].push_back(pair_of(strategies, pair));
  json["players"] = names_of(strategies, found.opaque);
  return json;
}

int same(const std::string& spec, Sense sense, std::size_t most_pairs, const Payoffs& payoffs, const Common& common) {
  const auto strategies = standard_names().roster(spec, payoffs);
  const SameStrategies found = same_strategies(strategies, sense, most_pairs);
  switch (common.format) {
    case Format::text: print_text(strategies, sense, found); break;
    case Format::csv: print_csv(strategies, found); break;
    case Format::json:
      std::cout << same_json(spec, strategies, sense, found).dump(2, ' ', false, Json::error_handler_t::replace)
                << "\n";
      break;
  }
  return done;
}

}  // namespace folk::tools
