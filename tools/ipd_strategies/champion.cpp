#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/ipd_strategies/champion.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/analysis/classes/champion.h>
#include <folk/analysis/evolution/sample_champion.h>
#include <folk/games/error.h>

#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace folk::tools {
namespace {

/// How sure it is, in a sentence.
std::string standing(const Champion& champion, const MemoryClass& members) {
  if (champion.proved)
    return fmt::format("proved: all {} members were ranked; {} earn as much, this one among them", members.size().str(),
                       champion.equals);
  return fmt::format(
      "found, not proved: {} members scored in a local search with {} local optima; {} were passed over, because they "
      "tell too many kinds of opponents apart",
      champion.evaluations, champion.local_optima, champion.passed_over);
}

nlohmann::ordered_json or_null(const std::optional<std::string>& text) {
  return text ? nlohmann::ordered_json(*text) : nlohmann::ordered_json(nullptr);
}

std::optional<std::string> exact_text(const ClassScore& score) {
  return score.exact_mean ? std::optional(to_text(*score.exact_mean)) : std::nullopt;
}

/// What the winner of a sample, or the champion, earns against the class.
void write_score(const ClassScore& score, const MemoryClass& members, const ClassScoreSettings& settings) {
  std::cout << fmt::format("earns {} a round against all {} members of {} ({}, {})\n", score.mean, members.size_text(),
                           members.name(), to_text(settings.payoffs), settings.criterion.to_string());
  if (const auto exact = exact_text(score)) std::cout << fmt::format("exactly {}\n", *exact);
  std::cout << fmt::format("cooperates in {:.2f} % of its moves\n", 100 * score.cooperation_rate);
}

void write_sample_text(const SampleChampions& found, const MemoryClass& members,
                       const SampleChampionSettings& settings) {
  for (const SampleWinner& winner : found.winners) {
    std::cout << winner.member << '\n';
    if (winner.score)
      write_score(*winner.score, members, settings);
    else
      std::cout << fmt::format("not scored against {}: it tells more than {} kinds of opponents apart\n",
                               members.name(), settings.most_leaves);
  }
  std::cout << fmt::format("most numerous in the ecology of {} members drawn with seed {}: {} of {} individuals\n",
                           settings.sample, settings.seed, number_text(found.winners.front().population),
                           number_text(found.individuals));
  std::cout << fmt::format("after {} generations{}; {} of the {} members are left\n", found.generations,
                           found.end == EvolutionEnd::none ? ", not at a fixed point" : "", found.survivors,
                           settings.sample);
}

void write_sample_csv(const SampleChampions& found, const MemoryClass& members,
                      const SampleChampionSettings& settings) {
  std::cout << "class,criterion,member,population,individuals,mean,cooperation_rate,sample,generations,fixed_point,"
               "survivors,seed\n";
  for (const SampleWinner& winner : found.winners)
    std::cout << fmt::format("\"{}\",{},{},{},{},{},{},{},{},{},{},{}\n", members.name(),
                             settings.criterion.to_string(), winner.member, number_text(winner.population),
                             number_text(found.individuals), winner.score ? fmt::format("{}", winner.score->mean) : "",
                             winner.score ? fmt::format("{}", winner.score->cooperation_rate) : "", settings.sample,
                             found.generations, found.end == EvolutionEnd::fixed_point, found.survivors, settings.seed);
}

void write_sample_json(const SampleChampions& found, const MemoryClass& members,
                       const SampleChampionSettings& settings) {
  nlohmann::ordered_json json;
  json["class"] = members.name();
  json["class_size"] = members.size().str();
  json["payoffs"] = to_text(settings.payoffs);
  json["criterion"] = settings.criterion.to_string();
  json["sample"] = settings.sample;
  json["seed"] = settings.seed;
  json["generations"] = found.generations;
  json["fixed_point"] = found.end == EvolutionEnd::fixed_point;
  json["survivors"] = found.survivors;
  json["individuals"] = found.individuals;
  json["winners"] = nlohmann::ordered_json::array();
  for (const SampleWinner& winner : found.winners) {
    nlohmann::ordered_json one;
    one["member"] = winner.member;
    one["population"] = winner.population;
    one["mean"] = winner.score ? nlohmann::ordered_json(winner.score->mean) : nlohmann::ordered_json(nullptr);
    one["exact_mean"] = or_null(winner.score ? exact_text(*winner.score) : std::nullopt);
    one["cooperation_rate"] =
        winner.score ? nlohmann::ordered_json(winner.score->cooperation_rate) : nlohmann::ordered_json(nullptr);
    json["winners"].push_back(one);
  }
  std::cout << json.dump(2) << "\n";
}

/// Who wins the ecology of a sample.
int champion_of_sample(const MemoryClass& members, const Payoffs& payoffs, const po::variables_map& values,
                       const Common& common) {
  if (values.count("evaluations") != 0)
    throw UsageError("--sample and --evaluations contradict: nothing is searched for in a sample");
  SampleChampionSettings settings;
  settings.payoffs = payoffs;
  settings.criterion = chosen_criterion(values);
  settings.sample = whole_option(values, "sample", 0, 1, MemoryClass::most_listed);
  settings.generations = whole_option(values, "generations", settings.generations, 0, 1'000'000'000'000'000);
  settings.seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  settings.most_leaves = whole_option(values, "most-kinds", settings.most_leaves, 1, std::uint64_t{1} << 62);
  settings.threads = threads_option(values, common);
  std::optional<ProgressBar> bar(
      std::in_place, fmt::format("the ecology of {} members of {}", settings.sample, members.name()), !common.quiet);
  const SampleChampions found = sample_champions(members, settings, std::ref(*bar));
  bar.reset();
  switch (common.format) {
    case Format::text: write_sample_text(found, members, settings); break;
    case Format::csv: write_sample_csv(found, members, settings); break;
    case Format::json: write_sample_json(found, members, settings); break;
  }
  return done;
}

}  // namespace

void add_champion_options(po::options_description& options) {
  auto add = options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("class", text(), "champion: memory(X,Y)");
  add("evaluations", text(), "champion: members that a search scores (default 20000)");
  add("most-kinds", text(),
      "champion: members that tell more kinds of opponents apart are passed over (default 200000, with --sample "
      "1000000000)");
  add("sample", text(),
      "champion: who wins the ecology of so many members that are drawn, and what it earns against all");
  add("generations", text(), "champion --sample: how far the ecology goes (default 1000)");
  add("seed", text(), "champion: of the search or the draw (default 1)");
}

int champion(const Payoffs& payoffs, const po::variables_map& values, const Common& common) {
  const std::string name = text_option(values, "class");
  const auto members = MemoryClass::parse(name);
  if (!members)
    throw UsageError(fmt::format("champion needs a class, --class 'memory(X,Y)'{}",
                                 name.empty() ? "" : fmt::format(", not '{}'", excerpt(name))));
  if (values.count("sample") != 0) return champion_of_sample(*members, payoffs, values, common);
  if (values.count("generations") != 0)
    throw UsageError("--generations is about the ecology of a sample: give --sample N");
  ChampionSettings settings;
  settings.payoffs = payoffs;
  settings.criterion = chosen_criterion(values);
  settings.seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  settings.evaluations = whole_option(values, "evaluations", 20'000, 1, 1'000'000'000);
  settings.most_leaves = whole_option(values, "most-kinds", 200'000, 1, 1'000'000'000);
  settings.threads = threads_option(values, common);
  std::optional<ProgressBar> bar(std::in_place, fmt::format("looking for the champion of {}", members->name()),
                                 !common.quiet);
  const Champion found = champion_of(*members, settings, std::ref(*bar));
  bar.reset();
  const ClassScore& score = found.score;
  switch (common.format) {
    case Format::text:
      std::cout << found.member << '\n';
      write_score(score, *members, settings);
      std::cout << standing(found, *members) << '\n';
      break;
    case Format::csv:
      std::cout << "class,criterion,member,mean,cooperation_rate,proved,equals,evaluations,passed_over,local_optima,"
                   "seed\n";
      std::cout << fmt::format("\"{}\",{},{},{},{},{},{},{},{},{},{}\n", members->name(),
                               settings.criterion.to_string(), found.member, score.mean, score.cooperation_rate,
                               found.proved, found.equals, found.evaluations, found.passed_over, found.local_optima,
                               settings.seed);
      break;
    case Format::json: {
      nlohmann::ordered_json json;
      json["class"] = members->name();
      json["class_size"] = members->size().str();
      json["payoffs"] = to_text(payoffs);
      json["criterion"] = settings.criterion.to_string();
      json["member"] = found.member;
      json["mean"] = score.mean;
      json["exact_mean"] = or_null(exact_text(score));
      json["cooperation_rate"] = score.cooperation_rate;
      json["proved"] = found.proved;
      json["equals"] = found.proved ? nlohmann::ordered_json(found.equals) : nlohmann::ordered_json(nullptr);
      json["evaluations"] = found.evaluations;
      json["passed_over"] = found.passed_over;
      json["local_optima"] = found.local_optima;
      json["seed"] = settings.seed;
      std::cout << json.dump(2) << "\n";
      break;
    }
  }
  return done;
}

}  // namespace folk::tools
