#pragma once
// What is known of one strategy, as programs print it.

#include <folk/strategies/facts.h>
#include <folk/strategies/registry.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// What the registry says, and what can be computed where the name stands for one machine.
struct Entry {
  Description description;
  std::optional<Facts> facts;
};

/// True for a name that stands for one strategy, as it is.
bool is_plain(const std::string& name);

/// Everything that has a name of its own; families, files and commands have no facts before they are filled in.
std::vector<Entry> named_entries(const Registry& registry);

/// These strategies, with what can be computed of each.
std::vector<Entry> entries_of(const std::vector<Strategy>& strategies);

/// "yes" or "no".
std::string yes_no(bool value);

/// Numbers of states: "3", "infinite", "over 100000".
std::string states_text(const Facts& facts, const std::optional<std::size_t>& states);

/// "yes", "no", or "yes, to 10000 rounds" where it is not proved.
std::string nice_text(const Niceness& niceness);

/// The entry as an object; what is not known is null.
nlohmann::ordered_json entry_json(const Entry& entry);

/// Lists of entries and of groups.
nlohmann::ordered_json entries_json(const std::vector<Entry>& entries, const std::vector<Description>& groups);

/// The entry as a line of CSV under entry_csv_header; `kind` is "strategy" or "group".
std::string entry_csv(const std::string& kind, const Entry& entry);
inline constexpr const char* entry_csv_header =
    "kind,name,aliases,memory,states,states_any_own_moves,deterministic,nice,behaviour,reference\n";

}  // namespace folk::tools
