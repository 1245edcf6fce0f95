#include <folk/tools/ipd_evolve/question.h>

#include <fmt/format.h>
#include <folk/analysis/evolution/family_selection.h>
#include <folk/analysis/evolution/finite_population.h>
#include <folk/analysis/evolution/integer_selection.h>
#include <folk/analysis/evolution/replicator.h>
#include <folk/games/error.h>
#include <folk/strategies/names.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace folk::tools {
namespace {

constexpr std::string_view models =
    "ecological, integer, real, encounter, moran, fermi, replicator, birth-death, pairwise";

/// An option, and the models it belongs to, between blanks.
struct Belonging {
  const char* option;
  std::string_view models;
};

constexpr std::array belongings{
    Belonging{"income", " integer real encounter moran fermi "},
    Belonging{"meets-itself", " integer birth-death pairwise "},
    Belonging{"resilience", " integer real "},
    Belonging{"tolerance", " real replicator "},
    Belonging{"mutation", " replicator birth-death pairwise "},
    Belonging{"intensity", " birth-death pairwise "},
    Belonging{"fitness", " birth-death "},
    Belonging{"individuals", " ecological integer encounter moran fermi birth-death pairwise "},
};

bool among(std::string_view blanked, std::string_view name) {
  return blanked.find(fmt::format(" {} ", name)) != std::string_view::npos;
}

Question asked(const po::variables_map& values) {
  if (values.count("runs") != 0) return Question::runs;
  if (values.count("fixation") != 0) return Question::fixation;
  return values.count("stationary") != 0 ? Question::stationary : Question::evolution;
}

/// Fixation is a question about birth-death or pairwise comparison.
std::string model_of(const po::variables_map& values) {
  return text_option(values, "model", asked(values) == Question::evolution ? "ecological" : "birth-death");
}

Income income_of(const po::variables_map& values) {
  const auto text = text_option(values, "income", "ind");
  if (text != "ind" && text != "com")
    throw UsageError(fmt::format("--income '{}': expected ind or com", excerpt(text)));
  return text == "ind" ? Income::individual : Income::communal;
}

double number_of(const po::variables_map& values, const char* option, const char* fallback, double high) {
  return parse_number(text_option(values, option, fallback), fmt::format("--{}", option), 0, high);
}

SelectionRules rules_of(const po::variables_map& values, const std::string& model) {
  SelectionRules rules;
  if (model == "pairwise") rules.process = Process::pairwise_comparison;
  const auto fitness = text_option(values, "fitness", "linear");
  if (fitness != "linear" && fitness != "exponential")
    throw UsageError(fmt::format("--fitness '{}': expected linear (1 - w + w payoff) or exponential (exp(w payoff))",
                                 excerpt(fitness)));
  if (fitness == "exponential") rules.fitness = Fitness::exponential;
  rules.intensity = parse_exact_number(text_option(values, "intensity", "0.1"), "--intensity", 0, 1e6);
  rules.meets_itself = values.count("meets-itself") != 0;
  check(rules);
  return rules;
}

/// Sets what --start says of single strategies.
void set_named(Population& start, const ScoreMatrix& scores, const std::string& text, bool shares) {
  std::vector<bool> named(start.size(), false);
  for (const auto& item : split_list(text)) {
    const auto equals = item.rfind('=');
    if (equals == std::string::npos)
      throw UsageError(fmt::format("--start '{}': expected NAME=N, as in all_d=500,tit_for_tat=10", excerpt(item)));
    const auto name = item.substr(0, equals);
    const auto found = std::find_if(scores.names().begin(), scores.names().end(),
                                    [&](const auto& other) { return same_name(name, other); });
    if (found == scores.names().end())
      throw UsageError(fmt::format("--start {}: it is not in the roster", excerpt(name)));
    const auto i = static_cast<std::size_t>(found - scores.names().begin());
    if (named[i]) throw UsageError(fmt::format("--start {}: it is named twice", excerpt(name)));
    named[i] = true;
    const auto what = fmt::format("--start {}", excerpt(name));
    const auto number = item.substr(equals + 1);
    start[i] =
        shares ? parse_number(number, what, 0, most_individuals)
               : static_cast<double>(parse_whole_number(number, what, 0, static_cast<std::uint64_t>(most_individuals)));
  }
}

Population start_of(const po::variables_map& values, const ScoreMatrix& scores, bool shares) {
  const auto most = static_cast<std::uint64_t>(most_individuals);
  const std::size_t n = scores.size();
  Population start(n, 100);
  if (values.count("individuals") != 0) {
    const auto all = whole_option(values, "individuals", 100, 1, most);
    for (std::size_t i = 0; i < n; ++i) start[i] = static_cast<double>(all / n + (i < all % n ? 1 : 0));
  } else {
    start.assign(n, static_cast<double>(whole_option(values, "population", 100, 0, most)));
  }
  if (values.count("start") != 0) set_named(start, scores, text_option(values, "start"), shares);
  if (std::all_of(start.begin(), start.end(), [](double number) { return number == 0; }))
    throw UsageError("nobody is there at the start: give --population or --start");
  return start;
}

DynamicsPtr dynamics_of(const po::variables_map& values, const std::shared_ptr<const ScoreMatrix>& scores,
                        const EvolveQuestion& asked_for) {
  const auto& [question, model] = std::pair(asked_for.question, asked_for.model);
  const Population& start = asked_for.start;
  if (asked_for.has_rules)
    return std::make_shared<FinitePopulation>(scores, start, asked_for.rules, number_of(values, "mutation", "0", 1));
  if (model == "ecological") return std::make_shared<IntegerSelection>(scores, start);
  if (model == "integer") {
    IntegerSelectionSettings settings;
    settings.income = income_of(values);
    settings.meets_itself = asked_for.meets_itself;
    settings.resilience = parse_exact_number(text_option(values, "resilience", "0"), "--resilience", 0, 1);
    return std::make_shared<IntegerSelection>(scores, start, settings, true);
  }
  if (model == "real" || model == "replicator") {
    ReplicatorSettings settings;
    settings.income = income_of(values);
    settings.resilience = number_of(values, "resilience", "0", 1);
    settings.mutation = number_of(values, "mutation", "0", 1);
    settings.tolerance = number_of(values, "tolerance", model == "real" ? "1e-5" : "1e-9", 1);
    return std::make_shared<Replicator>(scores, settings);
  }
  const auto kind = model == "encounter" ? FamilyModel::encounter
                    : model == "moran"   ? FamilyModel::moran
                                         : FamilyModel::fermi;
  return std::make_shared<FamilySelection>(scores, start, kind, income_of(values));
}

}  // namespace

void add_question_options(po::options_description& options) {
  auto add = options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("model", text(),
      "how a population becomes the next: ecological (default), integer, real, encounter, moran, fermi, replicator, "
      "birth-death, pairwise");
  add("population", text(), "of each strategy at the start (default 100)");
  add("individuals", text(),
      "of all strategies together, shared out evenly; for --fixation and --stationary the "
      "size of the population (default 100)");
  add("start", text(), "NAME=N,...: so many of these at the start");
  add("generations", text(), "how far to go (default 1000; a run of --runs: 100000000)");
  add("income", text(), "what a strategy earns among its own: ind (as it is, the default) or com (nothing)");
  add("meets-itself", "an individual also meets itself");
  add("resilience", text(), "this share of each strategy stays as it is (default 0)");
  add("tolerance", text(), "changes of no share by more count as none (default: real 1e-5, replicator 1e-9)");
  add("mutation", text(), "share of offspring that are of another strategy, each alike (default 0)");
  add("intensity", text(), "w, the intensity of selection, with payoffs a round (default 0.1)");
  add("fitness", text(), "linear (1 - w + w payoff, the default) or exponential (exp(w payoff))");
  add("runs", text(), "who takes over, by so many simulations from the start");
  add("fixation", "with which probability a single mutant takes over, for each pair");
  add("stationary", "how often the population is of each strategy when mutations are rare");
  add("exact", "--fixation and --stationary in fractions");
}

void check_question(const po::variables_map& values) {
  std::string first;
  for (const char* option : {"runs", "fixation", "stationary"})
    if (values.count(option) != 0) {
      if (!first.empty()) throw UsageError(fmt::format("--{} and --{} are two questions: ask one", first, option));
      first = option;
    }
  const auto model = model_of(values);
  if (!among(fmt::format(" {} ", fmt::join(split_list(std::string(models)), " ")), model))
    throw UsageError(fmt::format("--model '{}': expected {}", excerpt(model), models));
  for (const auto& [option, its] : belongings)
    if (values.count(option) != 0 && !among(its, model)) {
      auto names = std::string(its.substr(1, its.size() - 2));
      std::replace(names.begin(), names.end(), ' ', ',');
      throw UsageError(fmt::format("--{} does not belong to --model {}: it is for {}", option, model, names));
    }
  const Question question = asked(values);
  const auto refuse = [&](const char* option, std::string_view why) {
    if (values.count(option) != 0) throw UsageError(fmt::format("--{} and --{} contradict: {}", first, option, why));
  };
  if (question == Question::fixation || question == Question::stationary) {
    if (model != "birth-death" && model != "pairwise")
      throw UsageError(fmt::format("--{} is asked of --model birth-death or pairwise, not of {}", first, model));
    for (const char* option : {"population", "start", "generations"})
      refuse(option, "there is a single mutant at the start; give --individuals N");
    refuse("mutation",
           question == Question::stationary ? "its mutations are rare without end" : "nobody takes over for good");
    refuse("journal", "there is nothing to go on with");
  } else if (values.count("exact") != 0) {
    throw UsageError("--exact is for --fixation and --stationary");
  }
  if (question == Question::runs) {
    refuse("mutation", "nobody takes over for good");
    if (model == "ecological" || model == "integer" || model == "real" || model == "replicator")
      throw UsageError(fmt::format("--runs repeats what is random, and --model {} is not", model));
  }
  if (values.count("individuals") != 0 && values.count("population") != 0)
    throw UsageError("--individuals and --population contradict: give one of them");
}

EvolveQuestion chosen_question(const po::variables_map& values, const std::shared_ptr<const ScoreMatrix>& scores) {
  EvolveQuestion found;
  found.question = asked(values);
  found.model = model_of(values);
  found.meets_itself = values.count("meets-itself") != 0;
  found.has_rules = found.model == "birth-death" || found.model == "pairwise";
  if (found.has_rules) found.rules = rules_of(values, found.model);
  found.exact = values.count("exact") != 0;
  if (found.question == Question::fixation || found.question == Question::stationary) {
    if (scores->size() < 2) throw UsageError("fixation is a question about two strategies or more");
    found.individuals = whole_option(values, "individuals", 100, 2, 10'000'000);
    return found;
  }
  found.runs = whole_option(values, "runs", 0, 1, 1'000'000'000);
  found.generations = whole_option(values, "generations", found.question == Question::runs ? 100'000'000 : 1000, 0,
                                   1'000'000'000'000'000);
  found.start = start_of(values, *scores, found.model == "real" || found.model == "replicator");
  found.dynamics = dynamics_of(values, scores, found);
  return found;
}

}  // namespace folk::tools
