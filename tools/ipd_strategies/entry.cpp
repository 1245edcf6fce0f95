#include <folk/tools/ipd_strategies/entry.h>

#include <fmt/format.h>

#include <vector>

#include <folk/tools/program/csv.h>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

Json states_json(const Facts& facts, const std::optional<std::size_t>& states) {
  if (!facts.finite) return "infinite";
  return states ? Json(*states) : Json(nullptr);
}

Json memory_json(const Memory& memory) {
  switch (memory.kind) {
    case Memory::Kind::rounds: return memory.rounds;
    case Memory::Kind::unbounded: return "unbounded";
    case Memory::Kind::unknown: break;
  }
  return nullptr;
}

}  // namespace

std::string yes_no(bool value) { return value ? "yes" : "no"; }

std::string states_text(const Facts& facts, const std::optional<std::size_t>& states) {
  if (!facts.finite) return "infinite";
  return states ? std::to_string(*states) : fmt::format("over {}", most_counted_states);
}

std::string nice_text(const Niceness& niceness) {
  if (!niceness.rounds_tried) return yes_no(niceness.nice);
  return fmt::format("yes, to {} rounds", *niceness.rounds_tried);
}

Json entry_json(const Entry& entry) {
  Json json;
  json["name"] = entry.description.name;
  json["aliases"] = entry.description.aliases;
  if (const auto& facts = entry.facts) {
    json["memory"] = memory_json(facts->memory);
    json["states"] = states_json(*facts, facts->states);
    json["states_any_own_moves"] = states_json(*facts, facts->states_any_own_moves);
    json["deterministic"] = facts->deterministic;
    json["nice"] = facts->niceness.nice;
    json["nice_rounds_tried"] = facts->niceness.rounds_tried ? Json(*facts->niceness.rounds_tried) : Json(nullptr);
  } else {
    for (const char* key : {"memory", "states", "states_any_own_moves", "deterministic", "nice", "nice_rounds_tried"})
      json[key] = nullptr;
  }
  json["behaviour"] = entry.description.behaviour;
  json["reference"] = entry.description.reference;
  json["elsewhere"] = entry.description.elsewhere.empty() ? Json(nullptr) : Json(entry.description.elsewhere);
  return json;
}

std::string entry_csv(const std::string& kind, const Entry& entry) {
  std::vector<std::string> cells(5);
  if (const auto& facts = entry.facts)
    cells = {to_string(facts->memory), states_text(*facts, facts->states),
             states_text(*facts, facts->states_any_own_moves), yes_no(facts->deterministic),
             yes_no(facts->niceness.nice)};
  const Description& description = entry.description;
  return fmt::format("{},{},{},{},{},{}\n", kind, csv_field(description.name),
                     csv_field(fmt::format("{}", fmt::join(description.aliases, ";"))), fmt::join(cells, ","),
                     csv_field(description.behaviour), csv_field(description.reference));
}

bool is_plain(const std::string& name) {
  return name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
}

namespace {

/// Facts of a name that stands for one machine; families, files and commands have none before they are filled in.
std::optional<Facts> facts_of_name(const Registry& registry, const std::string& name) {
  if (!is_plain(name)) return std::nullopt;
  try {
    const Strategy strategy = registry.make(name);
    if (!strategy.machine) return std::nullopt;
    return facts_of(*strategy.machine);
  } catch (const InputFileError&) {  // a policy that is not installed: it is listed all the same
    return std::nullopt;
  }
}

}  // namespace

std::vector<Entry> named_entries(const Registry& registry) {
  std::vector<Entry> entries;
  for (const auto& description : registry.strategies())
    entries.push_back({description, facts_of_name(registry, description.name)});
  return entries;
}

std::vector<Entry> entries_of(const std::vector<Strategy>& strategies) {
  std::vector<Entry> entries;
  for (const auto& strategy : strategies)
    entries.push_back(
        {{strategy.name, {}, {}, {}}, strategy.machine ? std::optional(facts_of(*strategy.machine)) : std::nullopt});
  return entries;
}

nlohmann::ordered_json entries_json(const std::vector<Entry>& entries, const std::vector<Description>& groups) {
  nlohmann::ordered_json json;
  json["strategies"] = nlohmann::ordered_json::array();
  for (const auto& entry : entries) json["strategies"].push_back(entry_json(entry));
  json["groups"] = nlohmann::ordered_json::array();
  for (const auto& group : groups)
    json["groups"].push_back({{"name", group.name},
                              {"aliases", group.aliases},
                              {"behaviour", group.behaviour},
                              {"reference", group.reference}});
  return json;
}

}  // namespace folk::tools
