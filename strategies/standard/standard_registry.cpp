// Registry::standard(): every strategy, family and roster of Folk itself.

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/axelrod/axelrod_rules.h>
#include <folk/strategies/machine_text.h>
#include <folk/strategies/programs/exec_player.h>
#include <folk/strategies/quoted_text.h>
#include <folk/strategies/registry.h>
#include <folk/strategies/standard/badbet_machine.h>
#include <folk/strategies/standard/families.h>
#include <folk/strategies/standard/finite_strategies.h>
#include <folk/strategies/standard/gradual_machine.h>
#include <folk/strategies/standard/majority_machine.h>
#include <folk/strategies/standard/mem2_machine.h>
#include <folk/strategies/standard/memory_machine.h>
#include <folk/strategies/standard/named_machine.h>
#include <folk/strategies/standard/parametric_strategies.h>
#include <folk/strategies/standard/periodic_machine.h>
#include <folk/strategies/standard/rosters.h>
#include <folk/strategies/standard/selections.h>

#include <utility>

namespace folk {
namespace {

constexpr const char* mathieu_delahaye = "Mathieu & Delahaye, JASSS 20(4) 12, 2017";
constexpr const char* sct_program = "the program published with arXiv 2310.04579";

/// Registers a machine without parameters.
template <class M>
void add_machine(Registry& registry, Description description, M machine) {
  auto shared = std::make_shared<const M>(std::move(machine));
  registry.add(std::move(description), [shared](const std::string& name, std::string_view, const Payoffs&) {
    return Strategy{name, shared, nullptr};
  });
}

// ---- strategies that are data or take no parameters ----

/// The machine that a line of finite_strategies.cpp describes.
std::shared_ptr<const Machine> machine_of(std::string_view data) {
  if (data.starts_with("per_")) return std::make_shared<PeriodicMachine>(data.substr(4));
  if (auto memory = MemoryMachine::parse(data)) return std::make_shared<MemoryMachine>(*std::move(memory));
  return std::make_shared<Automaton>(read_machine_line(data));
}

Description description_of(const FiniteStrategy& entry) {
  return {std::string(entry.name),
          {entry.aliases.begin(), entry.aliases.end()},
          std::string(entry.behaviour),
          std::string(entry.reference),
          std::string(entry.elsewhere)};
}

void add_finite(Registry& registry, const FiniteStrategy& entry) {
  registry.add(description_of(entry),
               [data = entry.machine](const std::string& name, std::string_view, const Payoffs&) {
                 return Strategy{name, machine_of(data), nullptr};
               });
}

/// A line whose machine is that of a strategy with parameters, which the registry has.
void add_by_parameters(Registry& registry, const FiniteStrategy& entry) {
  registry.add(description_of(entry), [machine = registry.make(entry.machine).machine](
                                          const std::string& name, std::string_view, const Payoffs&) {
    return Strategy{name, machine, nullptr};
  });
}

/// Adds the next lines of the data, up to and with the one of this name; to the end without a name. The classics that
/// are no data stand among them in the order of the literature.
class FiniteLines {
public:
  void add_up_to(Registry& registry, std::string_view name) {
    for (bool found = false; !found && next_ != finite_strategies().end(); ++next_) {
      add_finite(registry, *next_);
      found = next_->name == name;
    }
  }

private:
  std::vector<FiniteStrategy>::const_iterator next_ = finite_strategies().begin();
};

using Counts = GradualMachine::Counts;
using Calm = GradualMachine::Calm;

void add_classics(Registry& registry, FiniteLines& finite) {
  finite.add_up_to(registry, "spiteful");
  add_machine(registry,
              {"soft_majo", {"GoByMajority"}, "C while their C count >= their D count (so C first)", mathieu_delahaye},
              MajorityMachine(MajorityMachine::Tie::cooperate));
  add_machine(
      registry,
      {"hard_majo", {"HardGoByMajority"}, "C only while their C count > their D count (so D first)", mathieu_delahaye},
      MajorityMachine(MajorityMachine::Tie::defect));
  finite.add_up_to(registry, "slow_tft");
  add_machine(registry,
              {"gradual",
               {},
               "C until provoked by a D; then n D in a row, n = all their D so far, and C, C to calm down",
               "Beaufils, Delahaye & Mathieu, Artificial Life V, 1996"},
              GradualMachine(Counts::every_defection, Calm::watches_second_round));
  finite.add_up_to(registry, "prober");
  add_machine(registry,
              {"mem2",
               {},
               "every two rounds by the last two: {CC, CC} -> tit_for_tat, {CD, DC} -> tf2t, else all_d; "
               "the second all_d stays",
               "Li & Kendall, IEEE Trans. CIAIG 6(4), 2014"},
              Mem2Machine(Mem2Machine::Memory::rounds));
}

void add_later(Registry& registry, FiniteLines& finite) {
  finite.add_up_to(registry, {});
  add_machine(registry,
              {"gradual_soft",
               {"OriginalGradual"},
               "as gradual, but n counts only the D that provoked it",
               "Beaufils, Delahaye & Mathieu, 1997 (as Axelrod-Python's OriginalGradual)"},
              GradualMachine(Counts::provocations_only, Calm::watches_second_round));
  add_machine(
      registry,
      {"gradual_sct", {}, "as gradual, but a D in either of the two calming rounds does not provoke", sct_program},
      GradualMachine(Counts::every_defection, Calm::ignores_both_rounds));
  add_machine(registry,
              {"mem2_sct",
               {},
               "as mem2 by payoff sums, but from round 3 on it chooses after each round, by that round twice",
               sct_program},
              Mem2Machine(Mem2Machine::Memory::stored_twice));
  add_machine(registry,
              {"badbet",
               {},
               "4 rounds each of tit_for_tat, all_c, spiteful, per_ccd; then 4 rounds of the one "
               "that paid most since it was last picked",
               mathieu_delahaye,
               "the program of Mathieu & Delahaye bets on a spiteful that looks back one round, and so differs once a "
               "move of its own slips: mathieu_badbet"},
              BadbetMachine(BadbetMachine::Spite::for_ever));
  add_machine(registry,
              {"mathieu_badbet",
               {},
               "as badbet, but with mathieu_spiteful for spiteful",
               "cristal-smac/ipd at 40c86c7, the program of Mathieu & Delahaye"},
              BadbetMachine(BadbetMachine::Spite::of_last_round));
}

// ---- names of a form, files and programs ----

void add_forms(Registry& registry, FileReader read) {
  registry.add_form(
      {"mem<X><Y>_<moves>", {}, "a move by the own last X and their last Y moves: mem12_ccCDCDDCDD", mathieu_delahaye},
      [](std::string_view name, const Payoffs&) -> std::optional<Strategy> {
        auto machine = MemoryMachine::parse(name);
        if (!machine) return std::nullopt;
        std::string canonical = machine->name();
        return named_machine(std::move(canonical), *std::move(machine));
      });
  registry.add_form({"per_<word>", {}, "the word for ever: per_ccdcd", mathieu_delahaye},
                    [](std::string_view name, const Payoffs&) -> std::optional<Strategy> {
                      const std::string key = name_key(name);
                      // "perfect" is no word: only names that go on with c and d are of this form.
                      if (!key.starts_with("per") || key.find_first_not_of("cd", 3) != std::string::npos)
                        return std::nullopt;
                      PeriodicMachine machine(std::string_view(key).substr(3));
                      std::string canonical = machine.name();
                      return named_machine(std::move(canonical), std::move(machine));
                    });
  registry.add_prefix(
      {"@FILE", {}, "all machines of a file, or @FILE#NAME one of them", "docs/machine-files.md"}, "@",
      [read = std::move(read)](std::string_view item, const Payoffs&) {
        const auto hash = item.rfind('#');
        const std::string path = unquoted(item.substr(0, hash));
        if (path.empty()) throw UsageError("'@' needs the name of a file, as in @my.machines");
        const std::string source = path == "-" ? "standard input" : path;
        std::vector<Strategy> found;
        for (auto& [name, machine] : read_machines(read(path), source))
          if (hash == std::string_view::npos || name_key(name) == name_key(item.substr(hash + 1)))
            found.push_back(named_machine(name, std::move(machine)));
        if (found.empty())
          throw InputFileError(fmt::format("{}: no machine of that name ({})", source, excerpt(item.substr(hash + 1))));
        return found;
      });
  for (const char* form : {":\"CMD\"", "(\"CMD\";...)"})
    registry.add_prefix(
        {fmt::format("exec{}", form),
         {},
         form[0] == ':' ? "a program that is asked for its moves on a pipe"
                        : "the same with timeout=SECONDS, start=SECONDS, deterministic",
         "docs/exec-protocol.md"},
        fmt::format("exec{}", form[0]), [open = form[0]](std::string_view item, const Payoffs&) {
          return std::vector<Strategy>{exec_strategy(parse_program_call(fmt::format("{}{}", open, item)))};
        });
}

}  // namespace

Registry Registry::standard(FileReader read) {
  Registry registry;
  FiniteLines finite;
  add_classics(registry, finite);
  add_later(registry, finite);
  add_parametric(registry);
  add_forms(registry, std::move(read));
  add_families(registry);
  add_selections(registry);
  add_rosters(registry);
  for (const auto& entry : library_strategies()) add_finite(registry, entry);
  for (const auto& entry : memory_one_strategies()) add_by_parameters(registry, entry);
  add_axelrod_rules(registry);
  add_library_rosters(registry);
  return registry;
}

}  // namespace folk
