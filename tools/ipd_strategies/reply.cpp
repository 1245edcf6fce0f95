#include <folk/analysis/play/criterion_table.h>
#include <folk/tools/ipd_strategies/reply.h>

#include <folk/tools/choices/chosen_machine.h>
#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/csv.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/table.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/analysis/replies/best_reply.h>
#include <folk/analysis/replies/memory_one_reply.h>
#include <folk/games/error.h>
#include <folk/strategies/machine_text.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Larger replies are not written out.
constexpr std::size_t most_written = 1000;

/// What is asked.
struct Question {
  std::string opponents;
  MatchRules rules;
  unsigned horizon = 0;
  unsigned threads = 1;

  std::string settings() const {
    return fmt::format("{}, {}, noise {}", to_text(rules.payoffs), rules.criterion.to_string(),
                       to_short_text(rules.noise));
  }

  Json json() const {
    Json settings;
    settings["payoffs"] = to_text(rules.payoffs);
    settings["criterion"] = rules.criterion.to_string();
    settings["noise"] = rules.noise.probability();
    return settings;
  }
};

Question question(const std::string& opponents, const Payoffs& payoffs, const po::variables_map& values,
                  const Common& common) {
  Question asked{opponents, {payoffs, chosen_criterion(values)}};
  asked.rules.noise = parse_number(text_option(values, "noise", "0"), "--noise", 0, 1);
  asked.horizon = static_cast<unsigned>(whole_option(values, "horizon", 0, 1, 10'000));
  asked.threads = threads_option(values, common);
  return asked;
}

void print_json(const Json& json) { std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n"; }

void print_line(const char* what, const std::string& text) {
  std::cout << visible_line(fmt::format("  {:<15}{}", what, text));
}

// ---- The exact reply to one machine --------------------------------------------------------------------------------

/// The machine as an @file holds it, or nothing when it is too large to be read.
std::optional<std::string> written(const std::string& name, const Automaton& machine) {
  if (machine.size() > most_written) return std::nullopt;
  return write_machine(name, machine);
}

std::string payoff_text(const BestReply& found) {
  std::string text = fmt::format("{}", found.payoff);
  if (found.horizon)
    return fmt::format("at least {}: every round after the first {} counts as the worst", text, *found.horizon);
  if (!found.exact) return fmt::format("{}, no reply earns {:.1g} more", text, found.residual);
  const std::string exact = to_text(*found.exact);
  return exact == text ? text + ", exactly" : fmt::format("{}, exactly {}", text, exact);
}

void print_exact(const Question& asked, const std::string& opponent, const BestReply& found,
                 const std::optional<std::string>& machine) {
  std::cout << visible_line(fmt::format("best reply to {} ({})", opponent, asked.settings()));
  print_line("payoff", payoff_text(found));
  print_line("states", fmt::format("{}", found.machine.size()));
  if (machine)
    std::cout << "\n# the reply as an @file holds it\n" << *machine;
  else
    print_line("machine", fmt::format("not written out, it has more than {} states", most_written));
}

struct ExactReply {
  std::string opponent;
  BestReply found;
  std::optional<std::string> machine;  ///< of the reply, written
};

ExactReply exact_reply(const Question& asked) {
  const Strategy opponent = chosen_machine(standard_names(), asked.opponents, asked.rules.payoffs, "replied to");
  BestReply found = best_reply(*opponent.machine, asked.rules, asked.horizon);
  auto machine = written("reply_to_" + opponent.name, found.machine);
  return {opponent.name, std::move(found), std::move(machine)};
}

Json exact_json(const Question& asked, const ExactReply& reply) {
  const BestReply& found = reply.found;
  Json json = asked.json();
  json["opponent"] = reply.opponent;
  json["payoff"] = found.payoff;
  json["exact"] = found.exact ? Json(to_text(*found.exact)) : Json(nullptr);
  json["residual"] = found.residual;
  json["horizon"] = found.horizon ? Json(*found.horizon) : Json(nullptr);
  json["states"] = found.machine.size();
  json["machine"] = reply.machine ? Json(*reply.machine) : Json(nullptr);
  return json;
}

void print_exact_csv(const Question& asked, const ExactReply& reply) {
  const BestReply& found = reply.found;
  std::cout << "opponent,criterion,noise,payoff,exact,residual,horizon,states\n"
            << fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(reply.opponent), asked.rules.criterion.to_string(),
                           asked.rules.noise.probability(), found.payoff, found.exact ? to_text(*found.exact) : "",
                           found.residual, found.horizon ? fmt::format("{}", *found.horizon) : "",
                           found.machine.size());
}

// ---- The best memory-one reply found -------------------------------------------------------------------------------

/// The strategy as a name that every program reads.
std::string mem1(const MemoryOne& strategy) {
  return fmt::format("mem1({};{})", strategy.opening == Move::C ? 'c' : 'd', fmt::join(strategy.after, ","));
}

struct Opponents {
  std::vector<std::string> names;
  WeightedOpponents population;
};

Opponents opponents(const Question& asked) {
  std::vector<std::string> names;
  std::vector<WeightedOpponent> members;
  const Sense sense = asked.rules.noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own;
  for (const Strategy& strategy : standard_names().roster(asked.opponents, asked.rules.payoffs)) {
    if (!strategy.machine)
      throw UsageError(fmt::format("{} is an opaque player: a reply can only be found to machines", strategy.name));
    if (!strategy.machine->finite() && !asked.rules.criterion.is_finite())
      throw UsageError(fmt::format("{} has infinitely many states: a memory-one reply to it needs finite:T, not {}",
                                   strategy.name, asked.rules.criterion.to_string()));
    names.push_back(strategy.name);
    members.push_back({minimise(table_for(*strategy.machine, asked.rules.criterion, sense, 0), sense), 1});
  }
  return {std::move(names), WeightedOpponents(std::move(members), asked.rules)};
}

std::string searched_text(const SearchCertificate& certificate) {
  std::string text = fmt::format("{} strategies, on each of the {} faces of [0,1]^4 with either opening",
                                 certificate.points, certificate.faces / 2);
  if (certificate.unsettled > 0) text += fmt::format("; {} searches did not settle", certificate.unsettled);
  return text;
}

void print_found(const Question& asked, const Opponents& met, const MemoryOneReply& found) {
  const SearchCertificate& certificate = found.certificate;
  std::cout << visible_line(fmt::format("best memory-one reply found to {} ({})", asked.opponents, asked.settings()));
  print_line("strategy", mem1(found.strategy));
  print_line("payoff", fmt::format("{:.10g}{}", found.payoff, met.names.size() > 1 ? ", the mean" : ""));
  if (met.names.size() > 1) {
    Table table({"", "against", "payoff"});
    for (std::size_t i = 0; i < met.names.size(); ++i)
      table.add({"", met.names[i], fmt::format("{:.6f}", met.population.payoff(found.strategy, i))});
    std::cout << "\n" << table.text() << "\n";
  }
  print_line("searched", searched_text(certificate));
  print_line("slope", fmt::format("{:.1e}, the steepest ascent that is left", certificate.slope));
  if (certificate.at_open_end)
    print_line("supremum", "not reached: a probability is the better the nearer it comes to 0 or 1, short of it");
  print_line("deterministic",
             fmt::format("{} earns {:.10g}, the most of all 32", mem1(certificate.corner), certificate.corner_payoff));
  print_line("all strategies",
             fmt::format("none earns more than {:.10g} (with {:.1g} for rounding): {:.2g} more than this one",
                         certificate.unrestricted, certificate.residual,
                         std::max(0.0, certificate.unrestricted - found.payoff)));
}

Json found_json(const Question& asked, const Opponents& met, const MemoryOneReply& found) {
  const SearchCertificate& certificate = found.certificate;
  Json json = asked.json();
  json["opponents"] = Json::array();
  for (std::size_t i = 0; i < met.names.size(); ++i)
    json["opponents"].push_back({{"name", met.names[i]},
                                 {"weight", met.population.member(i).weight},
                                 {"payoff", met.population.payoff(found.strategy, i)}});
  json["strategy"] = mem1(found.strategy);
  json["payoff"] = found.payoff;
  json["certificate"] = {{"faces", certificate.faces},
                         {"points", certificate.points},
                         {"unsettled", certificate.unsettled},
                         {"slope", certificate.slope},
                         {"at_open_end", certificate.at_open_end},
                         {"best_deterministic", mem1(certificate.corner)},
                         {"best_deterministic_payoff", certificate.corner_payoff},
                         {"unrestricted", certificate.unrestricted},
                         {"residual", certificate.residual}};
  return json;
}

void print_found_csv(const Question& asked, const MemoryOneReply& found) {
  const SearchCertificate& certificate = found.certificate;
  std::cout << "opponents,criterion,noise,strategy,payoff,points,slope,at_open_end,best_deterministic,"
               "best_deterministic_payoff,unrestricted,residual\n"
            << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(asked.opponents),
                           asked.rules.criterion.to_string(), asked.rules.noise.probability(),
                           csv_field(mem1(found.strategy)), found.payoff, certificate.points, certificate.slope,
                           certificate.at_open_end, csv_field(mem1(certificate.corner)), certificate.corner_payoff,
                           certificate.unrestricted, certificate.residual);
}

MemoryOneReply found_memory_one(const Question& asked, const Opponents& met, const Progress& progress) {
  return memory_one_reply(met.population, {2'000, asked.threads}, progress);
}

int reply_exactly(const Question& asked, const Common& common) {
  const ExactReply reply = exact_reply(asked);
  switch (common.format) {
    case Format::text: print_exact(asked, reply.opponent, reply.found, reply.machine); break;
    case Format::csv: print_exact_csv(asked, reply); break;
    case Format::json: print_json(exact_json(asked, reply)); break;
  }
  return done;
}

int reply_memory_one(const Question& asked, const Common& common) {
  const Opponents met = opponents(asked);
  const MemoryOneReply found = [&] {
    ProgressBar bar("searching", !common.quiet);
    return found_memory_one(asked, met, std::ref(bar));
  }();
  switch (common.format) {
    case Format::text: print_found(asked, met, found); break;
    case Format::csv: print_found_csv(asked, found); break;
    case Format::json: print_json(found_json(asked, met, found)); break;
  }
  return done;
}

/// What --memory-one says.
bool asks_memory_one(const Question& asked, const po::variables_map& values) {
  if (values.count("memory-one") == 0) return false;
  if (asked.horizon > 0) throw UsageError("--horizon does not go with --memory-one: take finite:T");
  return true;
}

}  // namespace

void add_reply_options(po::options_description& options) {
  add_criterion_options(options);
  auto add = options.add_options();
  add("noise", po::value<std::string>(), "reply: each move flips with this probability (default 0)");
  add("horizon", po::value<std::string>(), "reply: rounds of a machine without end that are looked at");
  add("memory-one", "reply: the best memory-one reply that a search finds, to one opponent or a SPEC of them");
  add("threads", po::value<std::string>(),
      "reply, equilibria, champion: threads (default: one a processor); the result does not depend on it");
}

int reply(const std::string& opponents, const Payoffs& payoffs, const po::variables_map& values, const Common& common) {
  const Question asked = question(opponents, payoffs, values, common);
  return asks_memory_one(asked, values) ? reply_memory_one(asked, common) : reply_exactly(asked, common);
}

Json reply_json(const std::string& opponents_spec, const Payoffs& payoffs, const po::variables_map& values,
                const Common& common, const Progress& progress) {
  const Question asked = question(opponents_spec, payoffs, values, common);
  if (!asks_memory_one(asked, values)) return exact_json(asked, exact_reply(asked));
  const Opponents met = opponents(asked);
  return found_json(asked, met, found_memory_one(asked, met, progress));
}

}  // namespace folk::tools
