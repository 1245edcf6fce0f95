// ipd-strategies: what Folk knows of the strategies, and whether two of them are the same.

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/equivalence.h>
#include <folk/strategies/facts.h>
#include <folk/strategies/machine_text.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include <folk/tools/choices/chosen_machine.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/ipd_strategies/champion.h>
#include <folk/tools/ipd_strategies/difference.h>
#include <folk/tools/ipd_strategies/entry.h>
#include <folk/tools/ipd_strategies/equilibria.h>
#include <folk/tools/ipd_strategies/reply.h>
#include <folk/tools/ipd_strategies/same.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/table.h>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Larger machines are not written out.
constexpr std::size_t most_shown = 1000;

// ---- list --------------------------------------------------------------------------------------------------------

/// Words on lines of at most `width` characters.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return lines;
}

/// Adds a row whose last cell takes as many lines as it needs.
void add_wrapped(Table& table, std::vector<std::string> row, std::size_t width) {
  const auto lines = wrapped(row.back(), width);
  for (const auto& line : lines) {
    row.back() = line;
    table.add(row);
    std::fill(row.begin(), row.end(), "");
  }
}

std::string with_aliases(const Description& description) {
  if (description.aliases.empty()) return description.behaviour;
  return fmt::format("{} (also {})", description.behaviour, fmt::join(description.aliases, ", "));
}

/// Of the strategies that have a line of facts.
std::size_t widest_name(const std::vector<Entry>& entries) {
  std::size_t width = 0;
  for (const auto& entry : entries)
    if (entry.facts) width = std::max(width, entry.description.name.size());
  return width;
}

std::size_t widest_name(const std::vector<Description>& descriptions) {
  std::size_t width = 0;
  for (const auto& description : descriptions) width = std::max(width, description.name.size());
  return width;
}

void print_list(const std::vector<Entry>& entries, const std::vector<Description>& groups) {
  constexpr std::size_t page = 120;
  constexpr std::size_t columns_of_facts = 47;
  std::vector<Description> families;
  std::vector<Description> players;
  Table strategies({"name", "memory", "states", "deterministic", "nice", "behaviour"});
  for (const auto& entry : entries) {
    if (!entry.facts) {
      (is_plain(entry.description.name) ? players : families).push_back(entry.description);
      continue;
    }
    const Facts& facts = *entry.facts;
    add_wrapped(strategies,
                {entry.description.name, to_string(facts.memory), states_text(facts, facts.states),
                 yes_no(facts.deterministic), yes_no(facts.niceness.nice), with_aliases(entry.description)},
                page - columns_of_facts - widest_name(entries));
  }
  std::cout << strategies.text();
  const auto print = [](const std::string& title, const std::vector<Description>& descriptions) {
    Table table({title, ""});
    for (const auto& description : descriptions)
      add_wrapped(table, {description.name, with_aliases(description)}, page - 2 - widest_name(descriptions));
    std::cout << "\n" << table.text();
  };
  print("with parameters", families);
  print("without a machine", players);
  print("rosters and families", groups);
}

void print_data(const std::vector<Entry>& entries, const std::vector<Description>& groups, Format format) {
  if (format == Format::csv) {
    std::cout << entry_csv_header;
    for (const auto& entry : entries) std::cout << entry_csv("strategy", entry);
    for (const auto& group : groups) std::cout << entry_csv("group", {group, std::nullopt});
    return;
  }
  std::cout << entries_json(entries, groups).dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

int list(const Common& common) {
  const Registry registry = standard_names();
  const std::vector<Entry> entries = named_entries(registry);
  if (common.format == Format::text)
    print_list(entries, registry.groups());
  else
    print_data(entries, registry.groups(), common.format);
  return done;
}

/// Whom a SPEC names, with what can be computed of each.
int list_roster(const std::string& spec, const Payoffs& payoffs, const Common& common) {
  const std::vector<Entry> entries = entries_of(standard_names().roster(spec, payoffs));
  if (common.format != Format::text) {
    print_data(entries, {}, common.format);
    return done;
  }
  Table table({"name", "memory", "states", "deterministic", "nice"});
  for (const auto& [description, facts] : entries)
    if (facts)
      table.add({description.name, to_string(facts->memory), states_text(*facts, facts->states),
                 yes_no(facts->deterministic), yes_no(facts->niceness.nice)});
    else
      table.add({description.name, "-", "-", "-", "-"});
  std::cout << table.text();
  return done;
}

// ---- show --------------------------------------------------------------------------------------------------------

/// The text form of the smallest machine that also answers alike when own moves slip, or why there is none.
struct Shown {
  std::string text;
  bool whole = false;
};

Shown machine_text(const Strategy& strategy, const std::optional<Facts>& facts) {
  if (!strategy.machine) return {"none: an opaque player", false};
  if (!facts->finite)
    return {fmt::format("infinitely many states; strategy-graph {} --horizon 6 draws the first rounds", strategy.name),
            false};
  if (!facts->states_any_own_moves || *facts->states_any_own_moves > most_shown)
    return {fmt::format("not written out, it has {} states; strategy-graph {} --horizon 6 draws the first rounds",
                        states_text(*facts, facts->states_any_own_moves), strategy.name),
            false};
  constexpr Sense any = Sense::any_own_moves;
  return {write_machine(strategy.name, minimise(*tabulate(*strategy.machine, any), any)), true};
}

/// All that is known of an entry, a fact a line.
void print_known(const Entry& entry, const std::string& family, const Shown& machine) {
  const auto line = [](const char* what, const std::string& text) {
    if (!text.empty()) std::cout << visible_line(fmt::format("  {:<15}{}", what, text));
  };
  const Description& description = entry.description;
  std::cout << visible_line(description.name);
  const bool from_file = family.starts_with('@');
  if (family != description.name && !from_file) line("described as", family);
  line("also known as", fmt::format("{}", fmt::join(description.aliases, ", ")));
  // Of a machine in a file the registry knows only what files are.
  if (!from_file) {
    line("behaviour", description.behaviour);
    line("reference", description.reference);
    line("elsewhere", description.elsewhere);
  }
  if (const auto& facts = entry.facts) {
    line("memory", facts->memory == Memory{Memory::Kind::rounds, 0}   ? "none"
                   : facts->memory == Memory{Memory::Kind::rounds, 1} ? "last round"
                   : facts->memory.kind == Memory::Kind::rounds ? fmt::format("last {} rounds", facts->memory.rounds)
                                                                : to_string(facts->memory));
    line("states", facts->finite
                       ? fmt::format("{} (own moves its own), {} (any own moves)", states_text(*facts, facts->states),
                                     states_text(*facts, facts->states_any_own_moves))
                       : "infinite");
    line("deterministic", yes_no(facts->deterministic));
    line("nice", nice_text(facts->niceness));
  }
  if (machine.whole)
    std::cout << "\n# the smallest machine for any own moves, as an @file holds it\n" << machine.text;
  else
    line("machine", machine.text);
}

int show(const std::string& name, const Payoffs& payoffs, const Common& common) {
  const Registry registry = standard_names();
  const Strategy strategy = registry.make(name, payoffs);
  Entry entry{registry.describe(name), std::nullopt};
  const std::string family = std::exchange(entry.description.name, strategy.name);
  if (strategy.machine) entry.facts = facts_of(*strategy.machine);
  if (common.format == Format::csv) {
    std::cout << entry_csv_header << entry_csv("strategy", entry);
    return done;
  }
  const Shown machine = machine_text(strategy, entry.facts);
  if (common.format == Format::text) {
    print_known(entry, family, machine);
    return done;
  }
  Json json = entry_json(entry);
  json["described_as"] = family;
  json["machine"] = machine.whole ? Json(machine.text) : Json(nullptr);
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  return done;
}

// ---- diff --------------------------------------------------------------------------------------------------------

int diff(const std::string& a, const std::string& b, Sense sense, std::size_t most_pairs, const Payoffs& payoffs,
         const Common& common) {
  const Registry registry = standard_names();
  const Strategy first = chosen_machine(registry, a, payoffs, "compared");
  const Strategy second = chosen_machine(registry, b, payoffs, "compared");
  const Difference result{first.name, second.name, sense,
                          compared(*first.machine, *second.machine, first.name == second.name, sense, most_pairs)};
  switch (common.format) {
    case Format::text: std::cout << visible_line(difference_text(result)); break;
    case Format::csv: std::cout << difference_csv(result); break;
    case Format::json:
      std::cout << difference_json(result).dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
      break;
  }
  return done;
}

// ---- the program -------------------------------------------------------------------------------------------------

Program ipd_strategies() {
  Program program;
  program.name = "ipd-strategies";
  program.title = "what is known of the strategies, and whether two of them are the same";
  program.usage =
      "list [SPEC] | show NAME | diff A B | same SPEC | equilibria SPEC | reply OPPONENTS | champion [options]";
  program.verbs = {{"list", "every strategy, roster and family, or those of a SPEC", {}},
                   {"show", "all that is known of one strategy", {}},
                   {"diff", "proves that two answer alike, or separates them", {}},
                   {"same", "which of a SPEC are one strategy under several names", {}},
                   {"equilibria", "from which discount factors on each of a SPEC is one with its copy", {}},
                   {"reply", "the best reply to one, or to several", {}},
                   {"champion", "the member of a complete class that earns most against all", {}}};
  program.summary =
      "list: every strategy, roster and family, with what can be computed of it, or those of SPEC. show: all that is\n"
      "known of one, with its machine. diff: proves that two strategies answer alike, or prints the shortest play of\n"
      "the opponent that separates them. same: those of SPEC that answer alike, each group proved. equilibria: the\n"
      "exact discount factors at which each of SPEC is in equilibrium with its copy. reply: the best reply to a\n"
      "machine, or with --memory-one the best memory-one reply that is found to several. champion: the member of a\n"
      "complete class that earns most against all of them, proved up to memory(2,2), else as a search finds it. NAME\n"
      "is a strategy, @FILE or @FILE#MACHINE (@- is the standard input); LABEL=NAME renames it.";
  program.examples = {"ipd-strategies list",
                      "ipd-strategies list 'sample(memory(2,2);5;seed=7)'",
                      "ipd-strategies show pavlov",
                      "ipd-strategies diff spiteful mem11_cCDDD",
                      "ipd-strategies diff spiteful mem11_cCDDD --any-own-moves",
                      "ipd-strategies same 'axelrod_library,all'",
                      "ipd-strategies equilibria classics",
                      "ipd-strategies reply pavlov --criterion discounted:0.9",
                      "ipd-strategies reply 'tit_for_tat,pavlov,all_d' --memory-one --criterion mean",
                      "ipd-strategies champion --class 'memory(2,2)' --rounds 1000"};
  auto add = program.options.add_options();
  add("any-own-moves", "diff, same: own moves may differ from the machine's own, as noise and deviations make them");
  add("most-pairs", po::value<std::string>(),
      "diff, same: joint states of a pair after which to stop (default 1000000; same: 100000)");
  add("payoffs", po::value<std::string>(), "T=5,R=3,P=1,S=0 (default): some strategies depend on them");
  add_reply_options(program.options);
  add_champion_options(program.options);
  program.arguments.add_options()("command", po::value<std::vector<std::string>>());
  program.positional.add("command", -1);
  program.registry = [] { return standard_names(); };
  return program;
}

int answer(const po::variables_map& values, const Common& common) {
  std::vector<std::string> words;
  if (values.count("command") != 0) words = values["command"].as<std::vector<std::string>>();
  if (words.empty())
    throw UsageError(
        "nothing asked: list, show NAME, diff A B, same SPEC, equilibria SPEC, reply OPPONENTS or champion");
  const std::string payoffs_text = text_option(values, "payoffs");
  const Payoffs payoffs = payoffs_text.empty() ? Payoffs{} : parse_payoffs(payoffs_text);
  const Sense sense = values.count("any-own-moves") != 0 ? Sense::any_own_moves : Sense::own_moves_its_own;
  const std::string& command = words.front();
  const std::size_t usual_pairs = command == "same" ? 100'000 : 1'000'000;
  const std::size_t most_pairs = whole_option(values, "most-pairs", usual_pairs, 1, 10'000'000);
  if (command == "list" && words.size() == 1) return list(common);
  if (command == "list" && words.size() == 2) return list_roster(words[1], payoffs, common);
  if (command == "show" && words.size() == 2) return show(words[1], payoffs, common);
  if (command == "diff" && words.size() == 3) return diff(words[1], words[2], sense, most_pairs, payoffs, common);
  if (command == "same" && words.size() == 2) return same(words[1], sense, most_pairs, payoffs, common);
  if (command == "equilibria" && words.size() == 2) return equilibria(words[1], payoffs, values, common);
  if (command == "reply" && words.size() == 2) return reply(words[1], payoffs, values, common);
  if (command == "champion" && words.size() == 1) return champion(payoffs, values, common);
  if (command == "champion") throw UsageError("champion takes no names: ipd-strategies champion --class 'memory(2,2)'");
  if (command == "list")
    throw UsageError("list takes at most one SPEC: ipd-strategies list, or ipd-strategies list classics");
  if (command == "show") throw UsageError("show takes one name: ipd-strategies show pavlov");
  if (command == "diff") throw UsageError("diff takes two names: ipd-strategies diff spiteful mem11_cCDDD");
  if (command == "same") throw UsageError("same takes one SPEC: ipd-strategies same axelrod_library");
  if (command == "equilibria") throw UsageError("equilibria takes one SPEC: ipd-strategies equilibria classics");
  if (command == "reply") throw UsageError("reply takes one SPEC of opponents: ipd-strategies reply pavlov");
  throw UsageError(
      fmt::format("'{}': expected list, show NAME, diff A B, same SPEC, equilibria SPEC, reply OPPONENTS or champion",
                  excerpt(command)));
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::ipd_strategies(), {"text", "csv", "json"}, folk::tools::answer);
}
