#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/ipd_strategies/champion.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/analysis/classes/champion.h>
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

}  // namespace

void add_champion_options(po::options_description& options) {
  auto add = options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("class", text(), "champion: memory(X,Y)");
  add("evaluations", text(), "champion: members that a search scores (default 20000)");
  add("most-kinds", text(),
      "champion: a search passes members over that tell more kinds of opponents apart (default 200000)");
  add("seed", text(), "champion: of the search (default 1)");
}

int champion(const Payoffs& payoffs, const po::variables_map& values, const Common& common) {
  const std::string name = text_option(values, "class");
  const auto members = MemoryClass::parse(name);
  if (!members)
    throw UsageError(fmt::format("champion needs a class, --class 'memory(X,Y)'{}",
                                 name.empty() ? "" : fmt::format(", not '{}'", excerpt(name))));
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
  const std::string exact = score.exact_mean ? to_text(*score.exact_mean) : "";
  switch (common.format) {
    case Format::text:
      std::cout << found.member << '\n';
      std::cout << fmt::format("earns {} a round against all {} members of {} ({}, {})\n", score.mean,
                               members->size_text(), members->name(), to_text(payoffs), settings.criterion.to_string());
      if (!exact.empty()) std::cout << fmt::format("exactly {}\n", exact);
      std::cout << fmt::format("cooperates in {:.2f} % of its moves\n", 100 * score.cooperation_rate);
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
      json["exact_mean"] = exact.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(exact);
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
