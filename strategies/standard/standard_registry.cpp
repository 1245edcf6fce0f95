// Registry::standard(): every strategy, family and roster of Folk itself.

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/machine_text.h>
#include <folk/strategies/memory_one.h>
#include <folk/strategies/programs/exec_player.h>
#include <folk/strategies/quoted_text.h>
#include <folk/strategies/registry.h>
#include <folk/strategies/standard/badbet_machine.h>
#include <folk/strategies/standard/finite_strategies.h>
#include <folk/strategies/standard/gradual_machine.h>
#include <folk/strategies/standard/majority_machine.h>
#include <folk/strategies/standard/mem2_machine.h>
#include <folk/strategies/standard/memory_class.h>
#include <folk/strategies/standard/memory_machine.h>
#include <folk/strategies/standard/periodic_machine.h>
#include <folk/strategies/standard/selections.h>

#include <array>
#include <limits>
#include <utility>

namespace folk {
namespace {

constexpr const char* mathieu_delahaye = "Mathieu & Delahaye, JASSS 20(4) 12, 2017";
constexpr const char* sct_program = "the program published with arXiv 2310.04579";

template <class M>
Strategy strategy(std::string name, M machine) {
  return {std::move(name), std::make_shared<M>(std::move(machine)), nullptr};
}

/// Registers a machine without parameters.
template <class M>
void add_machine(Registry& registry, Description description, M machine) {
  auto shared = std::make_shared<const M>(std::move(machine));
  registry.add(std::move(description), [shared](const std::string& name, std::string_view, const Payoffs&) {
    return Strategy{name, shared, nullptr};
  });
}

// ---- arguments ----

/// Arguments as text, split at ',' and ';', without the blanks around them; an empty one is kept.
std::vector<std::string> arguments_of(std::string_view text) {
  std::vector<std::string> arguments(1);
  for (const char c : text) {
    if (c == ',' || c == ';') {
      arguments.emplace_back();
    } else if (c != ' ') {
      arguments.back() += c;
    }
  }
  return arguments;
}

std::vector<Rational> probabilities(const std::vector<std::string>& arguments, std::size_t from,
                                    std::string_view what) {
  std::vector<Rational> values;
  for (std::size_t i = from; i < arguments.size(); ++i) values.push_back(parse_exact_number(arguments[i], what, 0, 1));
  return values;
}

/// Numbers as they stand in a name: "0.3,1/3".
template <class Numbers>
std::string listed(const Numbers& numbers) {
  std::string text;
  for (const Rational& number : numbers) {
    if (!text.empty()) text += ',';
    text += to_short_text(number);
  }
  return text;
}

void expect_count(const std::vector<std::string>& arguments, std::size_t least, std::size_t most,
                  const std::string& form) {
  if (arguments.size() < least || arguments.size() > most)
    throw UsageError(fmt::format("{} parameters given to {}", arguments.size(), form));
}

unsigned small_whole(const std::string& text, std::string_view what, unsigned low, unsigned high) {
  return static_cast<unsigned>(parse_whole_number(text, what, low, high));
}

// ---- strategies that are data or take no parameters ----

/// The machine that a line of finite_strategies.cpp describes.
std::shared_ptr<const Machine> machine_of(std::string_view data) {
  if (data.starts_with("per_")) return std::make_shared<PeriodicMachine>(data.substr(4));
  if (auto memory = MemoryMachine::parse(data)) return std::make_shared<MemoryMachine>(*std::move(memory));
  return std::make_shared<Automaton>(read_machine_line(data));
}

void add_finite(Registry& registry, const FiniteStrategy& entry) {
  registry.add({std::string(entry.name),
                {entry.aliases.begin(), entry.aliases.end()},
                std::string(entry.behaviour),
                std::string(entry.reference),
                std::string(entry.elsewhere)},
               [data = entry.machine](const std::string& full_name, std::string_view, const Payoffs&) {
                 return Strategy{full_name, machine_of(data), nullptr};
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

// ---- strategies with parameters ----

using FourProbabilities = std::array<Rational, 4>;

/// Registers a memory-one strategy whose parameters are all probabilities.
template <class Make>
void add_mixed(Registry& registry, Description description, std::size_t count, Make make) {
  const std::string form = description.name;
  const std::string head = form.substr(0, form.find('('));
  registry.add(std::move(description), [=](const std::string&, std::string_view text, const Payoffs&) {
    const auto arguments = arguments_of(text);
    expect_count(arguments, count, count, form);
    const auto exact = probabilities(arguments, 0, form);
    std::vector<double> p;
    for (const Rational& number : exact) p.push_back(to_double(number));
    return strategy(fmt::format("{}({})", head, listed(exact)), make(p));
  });
}

void add_zero_determinant(Registry& registry, Description description, Baseline baseline) {
  const std::string form = description.name;
  const std::string head = form.substr(0, form.find('('));
  registry.add(std::move(description), [=](const std::string&, std::string_view text, const Payoffs& payoffs) {
    const auto arguments = arguments_of(text);
    expect_count(arguments, 1, 2, form);
    const Rational chi = parse_exact_number(arguments[0], form + " chi", 1, 1e6);
    if (arguments.size() == 1)
      return strategy(fmt::format("{}({})", head, to_short_text(chi)),
                      memory_one(1, zero_determinant(payoffs, baseline, chi)));
    const Rational phi = parse_exact_number(arguments[1], form + " phi", 0, 1e6);
    return strategy(fmt::format("{}({};{})", head, to_short_text(chi), to_short_text(phi)),
                    memory_one(1, zero_determinant(payoffs, baseline, chi, phi)));
  });
}

Strategy memory_one_strategy(const Rational& first, const FourProbabilities& p) {
  const std::string opening = first == 1 ? "c" : first == 0 ? "d" : to_short_text(first);
  return strategy(fmt::format("mem1({};{})", opening, listed(p)),
                  memory_one(to_double(first), {to_double(p[0]), to_double(p[1]), to_double(p[2]), to_double(p[3])}));
}

void add_parametric(Registry& registry) {
  add_mixed(registry, {"random(p)", {}, "C with probability p", mathieu_delahaye}, 1, [](const std::vector<double>& p) {
    return Automaton({{p[0], {0, 0, 0, 0}}}, 0);
  });
  registry.add({"mem1(first;pCC,pCD,pDC,pDD)",
                {},
                "first c, d or a probability; then C by the last round (own, their)",
                "Nowak & Sigmund, Acta Applicandae Mathematicae 20, 1990"},
               [](const std::string& form, std::string_view text, const Payoffs&) {
                 const auto arguments = arguments_of(text);
                 expect_count(arguments, 5, 5, form);
                 const std::string opening = name_key(arguments[0]);
                 const Rational first = opening == "c"   ? Rational(1)
                                        : opening == "d" ? Rational(0)
                                                         : parse_exact_number(arguments[0], "first move", 0, 1);
                 const auto p = probabilities(arguments, 1, form);
                 return memory_one_strategy(first, {p[0], p[1], p[2], p[3]});
               });
  add_mixed(
      registry,
      {"gtft(q)", {}, "C; after their C: C; after their D: C with probability q", "Nowak & Sigmund, Nature 355, 1992"},
      1, [](const std::vector<double>& q) {
        return memory_one(1, {1, q[0], 1, q[0]});
      });
  add_mixed(registry,
            {"joss(p)",
             {},
             "tit_for_tat that plays D instead of C (the first C too) with probability 1 - p",
             "Axelrod, Journal of Conflict Resolution 24, 1980"},
            1, [](const std::vector<double>& p) {
              return memory_one(p[0], {p[0], 0, p[0], 0});
            });
  add_zero_determinant(
      registry,
      {"zd_extort(chi;phi)", {}, "C; then own payoff - P = chi (their payoff - P)", "Press & Dyson, PNAS 109, 2012"},
      Baseline::punishment);
  add_zero_determinant(registry,
                       {"zd_generous(chi;phi)",
                        {},
                        "C; then own payoff - R = chi (their payoff - R)",
                        "Stewart & Plotkin, PNAS 110, 2013"},
                       Baseline::reward);
  registry.add({"equalizer(v;pCC,pDD)",
                {},
                "C; then their long-run payoff is v whatever they play",
                "Press & Dyson, PNAS 109, 2012"},
               [](const std::string& form, std::string_view text, const Payoffs& payoffs) {
                 const auto arguments = arguments_of(text);
                 expect_count(arguments, 1, 3, form);
                 const Rational v = parse_exact_number(arguments[0], form + " v", -1e6, 1e6);
                 const auto p = probabilities(arguments, 1, form);
                 const auto given = [&](std::size_t i) { return i < p.size() ? std::optional(p[i]) : std::nullopt; };
                 return strategy(p.empty() ? fmt::format("equalizer({})", to_short_text(v))
                                           : fmt::format("equalizer({};{})", to_short_text(v), listed(p)),
                                 memory_one(1, equalizer(payoffs, v, given(0), given(1))));
               });
}

// ---- names of a form, files and programs ----

void add_forms(Registry& registry, FileReader read) {
  registry.add_form(
      {"mem<X><Y>_<moves>", {}, "a move by the own last X and their last Y moves: mem12_ccCDCDDCDD", mathieu_delahaye},
      [](std::string_view name, const Payoffs&) -> std::optional<Strategy> {
        auto machine = MemoryMachine::parse(name);
        if (!machine) return std::nullopt;
        std::string canonical = machine->name();
        return strategy(std::move(canonical), *std::move(machine));
      });
  registry.add_form({"per_<word>", {}, "the word for ever: per_ccdcd", mathieu_delahaye},
                    [](std::string_view name, const Payoffs&) -> std::optional<Strategy> {
                      const std::string key = name_key(name);
                      // "perfect" is no word: only names that go on with c and d are of this form.
                      if (!key.starts_with("per") || key.find_first_not_of("cd", 3) != std::string::npos)
                        return std::nullopt;
                      PeriodicMachine machine(std::string_view(key).substr(3));
                      std::string canonical = machine.name();
                      return strategy(std::move(canonical), std::move(machine));
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
            found.push_back(strategy(name, std::move(machine)));
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

// ---- rosters and families ----

Family memory_family(std::string_view arguments) {
  const MemoryClass members = MemoryClass::of_arguments(arguments);
  const std::string name = members.name();
  return {name, members.size(),
          [members](const Integer& number) {
            auto machine = members.member(number);
            std::string genotype = machine.name();
            return strategy(std::move(genotype), std::move(machine));
          },
          fmt::format("{} has {} members, more than the {} that can be listed: it is ranked as a whole by "
                      "ipd-tournament --strategies '{}' alone, scores entrants by --class '{}', and lends some of its "
                      "members by 'sample({};40)'",
                      name, members.size_text(), Family::most_listed, name, name, name)};
}

/// Word number 0, 1, ...: "c", "d", "cc", "cd", ...
Strategy word_of_number(std::uint64_t number) {
  unsigned length = 1;
  for (; number >= std::uint64_t{1} << length; ++length) number -= std::uint64_t{1} << length;
  std::string word;
  for (unsigned i = length; i-- > 0;) word += ((number >> i) & 1U) != 0 ? 'd' : 'c';
  return strategy("per_" + word, PeriodicMachine(word));
}

/// Number 0, 1, ... of those that open with C, then of those that open with D.
Strategy probabilities_of_number(std::uint64_t number, unsigned steps) {
  const std::uint64_t values = steps + 1;
  const std::uint64_t tables = values * values * values * values;
  const bool opens_with_c = number < tables;
  FourProbabilities p{};
  for (std::size_t i = 4; i-- > 0; number /= values) p[i] = Rational(number % values, steps);
  return memory_one_strategy(opens_with_c ? 1 : 0, p);
}

std::uint64_t small_number(const Integer& number) { return static_cast<std::uint64_t>(number.word()); }

void add_families(Registry& registry) {
  registry.add_family({"memory(X,Y)", {}, "all genotypes of own last X and their last Y moves", mathieu_delahaye},
                      memory_family);
  registry.add_family({"periodic(n)", {}, "all words of up to n moves, for ever", mathieu_delahaye},
                      [](std::string_view text) {
                        const unsigned longest = small_whole(std::string(text), "periodic(n) n", 1, 13);
                        return Family{fmt::format("periodic({})", longest), (Integer(2) << longest) - 2,
                                      [](const Integer& number) { return word_of_number(small_number(number)); }};
                      });
  registry.add_family(
      {"proba(K)", {}, "all mem1 with first move c or d and probabilities 0, 1/K, ..., 1", mathieu_delahaye},
      [](std::string_view text) {
        const unsigned steps = small_whole(std::string(text), "proba(K) K", 1, 9);
        return Family{fmt::format("proba({})", steps), 2 * pow(Integer(steps + 1), 4),
                      [steps](const Integer& number) { return probabilities_of_number(small_number(number), steps); }};
      });
}

void add_rosters(Registry& registry) {
  constexpr const char* first =
      "all_c,all_d,tit_for_tat,spiteful,soft_majo,hard_majo,per_ddc,per_ccd,mistrust,per_cd,"
      "pavlov,tf2t,hard_tft,slow_tft,";
  registry.add_roster({"classics", {}, "the 17 classical strategies", "Mathieu & Delahaye, JASSS 20(4) 12, 2017, 3.3"},
                      std::string(first) + "gradual,prober,mem2");
  registry.add_roster({"sct2025",
                       {},
                       "the classics with gradual_sct and mem2_sct, as the SCT paper's program plays them",
                       "arXiv 2310.04579v2"},
                      std::string(first) + "gradual_sct,prober,mem2_sct");
  std::string all;
  for (const auto& description : registry.strategies())
    if (description.name.find_first_of("(<@:") == std::string::npos) all += description.name + ",";
  registry.add_roster({"all", {}, "every named strategy without parameters", "ipd-strategies list"}, std::move(all));
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
  return registry;
}

}  // namespace folk
