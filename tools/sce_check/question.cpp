#include <folk/tools/sce_check/question.h>

#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/policy_names.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/output_folder.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/analysis/equilibria/continuation.h>
#include <folk/analysis/equilibria/examination.h>
#include <folk/analysis/equilibria/settlement.h>
#include <folk/games/error.h>
#include <folk/strategies/programs/program_rules.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

/// A file rather than a name: no strategy is called so (sct:DIR/FILE, gtft(1/3)), and there is such a file or it looks
/// like a path.
bool is_file_name(const Registry& registry, const std::string& name) {
  if (name.starts_with("@") || names_a_program(name) || policy_file(name)) return false;
  std::error_code error;
  const bool there = fs::is_regular_file(name, error);
  const bool has_parameters = name.ends_with(')') && name.find('(') != std::string::npos;
  const bool is_path = name.find('/') != std::string::npos && !has_parameters;
  if (!there && !is_path && !name.ends_with(".bin") && !name.ends_with(".safetensors")) return false;
  try {
    registry.describe(name);
    return false;
  } catch (const UsageError&) {
    return true;
  }
}

/// POLICY as a label and what it labels; the name of a file may hold a '='.
LabelledItem policy_named(const std::string& name) {
  std::error_code error;
  if (fs::is_regular_file(name, error)) return {std::nullopt, name};
  return split_label(name);
}

/// A gain that is allowed, kept as it was written: "0.1", "2/3".
Rational epsilon_payoff(const po::variables_map& values) {
  const Rational epsilon = parse_rational(text_option(values, "epsilon-payoff", "0"));
  if (epsilon < 0)
    throw UsageError(
        fmt::format("--epsilon-payoff '{}': expected 0 or more", excerpt(text_option(values, "epsilon-payoff"))));
  return epsilon;
}

Sides sides_of(const std::string& text) {
  if (text == "both") return Sides::both;
  if (text == "own") return Sides::first;
  if (text == "theirs") return Sides::second;
  throw UsageError(fmt::format("--side '{}': expected both, own or theirs", excerpt(text)));
}

std::optional<std::string> required(const po::variables_map& values) {
  if (values.count("require") == 0) return std::nullopt;
  const std::string text = text_option(values, "require");
  for (const char* known : {"nash", "subgame-perfect", "self-confirming", "beliefs"})
    if (text == known) return text;
  throw UsageError(
      fmt::format("--require '{}': expected nash, subgame-perfect, self-confirming or beliefs", excerpt(text)));
}

/// --from: a round, or from which one on everything holds.
void choose_from(const po::variables_map& values, SceQuestion& question) {
  if (values.count("from") == 0) return;
  if (question.extract) throw UsageError("--from and --extract contradict: an automaton is made of whole matches");
  question.settled = text_option(values, "from") == "settled";
  if (question.settled) {
    check_settlement(question);
  } else {
    question.from = parse_whole_number(text_option(values, "from"), "--from (or --from settled)", 1, most_path_rounds);
    check_from(question);
  }
}

/// Nobody asked for them: machines without end, which a criterion without end cannot judge.
void leave_out_endless(SceQuestion& question) {
  std::erase_if(question.opponents, [&](const Strategy& opponent) {
    const bool endless = !opponent.machine || !opponent.machine->finite();
    if (endless) question.left_out.push_back(opponent.name);
    return endless;
  });
}

std::vector<Strategy> class_of(const std::string& spec, std::vector<Strategy> beliefs) {
  std::erase_if(beliefs, [](const Strategy& strategy) { return !strategy.machine; });
  if (beliefs.empty())
    throw UsageError(fmt::format("--class {}: no machine is in it, and beliefs are machines", excerpt(spec)));
  return beliefs;
}

}  // namespace

void add_sce_options(Program& program) {
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("opponents", text(), "SPEC of whom POLICY is checked against (default: its training roster, else classics)");
  add_criterion_options(program.options);
  add("noise", text(), "each move of both, of a deviation too, flips with this probability (default 0)");
  add("class", text(), "SPEC of the machines that the other side may be believed to be (default: the opponents)");
  add("from", text(), "ask from this round on, after what is really played before; or settled: from which one on");
  add("side", text()->default_value("both"), "whose gains a verdict is about: both, own (POLICY's) or theirs");
  add("epsilon-belief", text(), "beliefs may be as far as this from the truth (default 0.05)");
  add("epsilon-payoff", text(), "a deviation may gain as much as this (default 0)");
  add("depth", text(),
      "rounds of the search on POLICY's own beliefs, 1 to 9 (default: as many as it plans ahead, else 6)");
  add("horizon", text(), "rounds that machines without end are followed under criteria without end");
  add("extract", "also make an automaton that plays as POLICY does");
  add("require", text(), "exit 1 when it is refuted: nash, subgame-perfect, self-confirming or beliefs");
  add_game_options(program.options);
  add_play_options(program.options);
  add("repetitions", text(), "matches of a pair that can only be sampled (default 100)");
  add("seed", text(), "of all random numbers (default 1)");
  add("threads", text(), "threads (default: one a processor); the results do not depend on it");
  add("output", text(), "folder for report.html, report.json and the extracted automaton");
  program.arguments.add_options()("name", po::value<std::vector<std::string>>());
  program.positional.add("name", 2);
}

SceQuestion sce_question(const po::variables_map& values, const Common& common) {
  const auto names =
      values.count("name") != 0 ? values["name"].as<std::vector<std::string>>() : std::vector<std::string>{};
  if (names.empty()) throw UsageError("no policy named: try sce-check sct, or sce-check pavlov pavlov");
  const sct::PlayOptions options = chosen_play_options(values);
  const Registry registry = standard_names(options);
  SceQuestion question;
  const auto [label, spec] = policy_named(names[0]);
  const std::string named(spec);
  const bool is_file = is_file_name(registry, named);
  const auto file = is_file ? std::optional<fs::path>(named) : policy_file(named);
  if (file) question.mind = read_mind(*file);
  const auto* training = question.mind ? &question.mind->policy.training : nullptr;

  question.game = chosen_game(values);
  const bool own_game = values.count("payoffs") == 0 && values.count("game") == 0;
  if (training != nullptr && own_game) {
    question.game.payoffs = training->payoffs;
    question.game.title = usual_name(training->payoffs);
    const auto& actions = question.mind->policy.action_names;
    if (actions.size() == 2) question.game.actions = {actions[0], actions[1]};
  }
  question.payoffs = question.game.payoffs;
  const Payoffs& payoffs = question.payoffs;
  question.policy = file ? sct::transformer(label.value_or(is_file ? "sct:" + named : named), question.mind, options)
                         : registry.make(names[0], payoffs);

  const bool own_criterion =
      values.count("rounds") == 0 && values.count("criterion") == 0 && values.count("end-probability") == 0;
  question.criterion =
      training != nullptr && own_criterion ? Criterion::parse(training->criterion) : chosen_criterion(values);
  if (!question.policy.machine && !question.criterion.is_finite())
    throw UsageError(fmt::format("{} is played, not enumerated: claims about it need finite:T, not {}",
                                 question.policy.name, question.criterion.to_string()));

  if (names.size() == 2 && values.count("opponents") != 0)
    throw UsageError("OPPONENT and --opponents contradict: give one of them");
  const std::string trained_on = training != nullptr && !training->roster.empty() ? training->roster : "classics";
  question.opponents_spec = names.size() == 2 ? names[1] : text_option(values, "opponents", trained_on);
  if (names.size() == 2)
    question.opponents = {names[1] == names[0] && !file ? question.policy : registry.make(names[1], payoffs)};
  else
    question.opponents = registry.roster(question.opponents_spec, payoffs);
  const bool chosen = names.size() == 2 || values.count("opponents") != 0 || values.count("horizon") != 0;
  if (!chosen && !question.criterion.is_finite()) leave_out_endless(question);
  question.command = common.command;
  question.imitated = registry.roster("classics", payoffs);
  question.class_spec = text_option(values, "class", question.opponents_spec);
  if (values.count("class") != 0)
    question.beliefs = class_of(question.class_spec, question.class_spec == question.opponents_spec
                                                         ? question.opponents  // the same machines: prepared once
                                                         : registry.roster(question.class_spec, payoffs));
  else
    std::copy_if(question.opponents.begin(), question.opponents.end(), std::back_inserter(question.beliefs),
                 [](const Strategy& strategy) { return strategy.machine != nullptr; });

  question.sides = sides_of(text_option(values, "side"));
  question.epsilon_belief = parse_number(text_option(values, "epsilon-belief", "0.05"), "--epsilon-belief", 0, 1);
  question.epsilon_payoff = epsilon_payoff(values);
  question.depth = whole_option(values, "depth", 0, 1, 9);
  question.horizon = static_cast<unsigned>(whole_option(values, "horizon", 0, 1, 10'000));
  question.extract = values.count("extract") != 0;
  if (question.extract && question.policy.machine)
    throw UsageError(fmt::format("--extract: {} is a machine already, strategy-graph draws it", question.policy.name));
  question.require = required(values);
  if (question.require == "beliefs" && question.policy.machine)
    throw UsageError(fmt::format("--require beliefs: {} is a machine and holds none", question.policy.name));
  question.noise = parse_number(text_option(values, "noise", "0"), "--noise", 0, 1);
  check_noise(question);
  choose_from(values, question);
  question.repetitions = whole_option(values, "repetitions", 100, 1, 1'000'000);
  question.seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  question.threads = threads_option(values, common);
  question.output = output_folder(values);
  return question;
}

}  // namespace folk::tools
