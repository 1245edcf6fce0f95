#include <folk/tools/choices/game_option.h>
#include <folk/tools/sct_train/config.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/games/utf8.h>
#include <folk/strategies/names.h>
#include <folk/strategies/nearest_names.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string_view>

namespace folk::tools {
namespace {

constexpr std::uint64_t most_steps = 1'000'000'000;
constexpr std::uint64_t most_rounds = 100'000;  // each has a row of the time table
constexpr std::size_t most_targets = 100;

/// One key: how its text is taken, and how its value is written. `what` is what a message calls the key.
struct Key {
  std::string name;
  std::string help;
  std::function<void(TrainConfig&, const std::string& text, const std::string& what)> set;
  std::function<std::string(const TrainConfig&)> show;
};

template <class Field>
Key whole_key(std::string name, std::string help, std::uint64_t low, std::uint64_t high, Field field) {
  const auto set = [=](TrainConfig& config, const std::string& text, const std::string& what) {
    field(config) = parse_whole_number(text, what, low, high);
  };
  return {std::move(name), std::move(help), set,
          [=](const TrainConfig& config) { return fmt::to_string(field(config)); }};
}

template <class Field>
Key real_key(std::string name, std::string help, double low, double high, Field field) {
  const auto set = [=](TrainConfig& config, const std::string& text, const std::string& what) {
    field(config) = parse_number(text, what, low, high);
  };
  return {std::move(name), std::move(help), set,
          [=](const TrainConfig& config) { return fmt::format("{}", field(config)); }};
}

/// `check` throws UsageError for a text that the key cannot have; its second argument names the key.
template <class Field, class Check>
Key text_key(std::string name, std::string help, Field field, Check check) {
  const auto set = [=](TrainConfig& config, const std::string& text, const std::string& what) {
    if (text.empty()) throw UsageError(fmt::format("{} '': expected a value", what));
    check(text, what);
    field(config) = text;
  };
  return {std::move(name), std::move(help), set, [=](const TrainConfig& config) { return field(config); }};
}

void any_text(const std::string&, const std::string&) {}

/// From the least to the largest payoff. Throws UsageError where there is no difference to learn from.
Rational range_of(const Payoffs& payoffs) {
  const auto& [t, r, p, s] = payoffs;
  const auto [least, most] = std::minmax({t, r, p, s});
  if (least == most) throw UsageError(fmt::format("in {} no move earns more than another", to_text(payoffs)));
  return most - least;
}

void check_loss(const std::string& text, const std::string& what) {
  if (text != "teacher" && text != "selfconf" && text != "rmadt" && text != "madt")
    throw UsageError(fmt::format("{} '{}': expected teacher, selfconf, rmadt or madt", what, excerpt(text)));
}

std::uint64_t decay_steps(const std::string& text, std::uint64_t all, const std::string& what) {
  if (text == "no") return 0;
  if (text == "yes") return all;
  const std::uint64_t number = whole_number(text).value_or(0);
  if (number == 0 || number > most_steps)
    throw UsageError(fmt::format("{} '{}': expected yes, no or a number of steps", what, excerpt(text)));
  return number;
}

/// "260:360:20" (from, to, by) or "260,300,320", lowest first.
std::vector<double> parse_targets(const std::string& text, const std::string& what) {
  constexpr double most = 1e15;
  const auto numbers = [&](char separator) {
    std::vector<double> list;
    for (std::size_t begin = 0; begin <= text.size();) {
      const auto end = std::min(text.find(separator, begin), text.size());
      list.push_back(parse_number(text.substr(begin, end - begin), what, -most, most));
      begin = end + 1;
    }
    return list;
  };
  std::vector<double> targets;
  if (text.find(':') == std::string::npos) {
    targets = numbers(',');
    std::sort(targets.begin(), targets.end());
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
  } else {
    const auto range = numbers(':');
    if (range.size() != 3 || range[1] < range[0] || range[2] <= 0)
      throw UsageError(fmt::format("{} '{}': expected FROM:TO:BY, as in 260:360:20", what, excerpt(text)));
    const double count = std::floor((range[1] - range[0]) / range[2] + 1e-9) + 1;
    if (count <= static_cast<double>(most_targets))
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        targets.push_back(range[0] + static_cast<double>(i) * range[2]);
  }
  if (targets.empty() || targets.size() > most_targets)
    throw UsageError(fmt::format("{} '{}': more than {} targets", what, excerpt(text), most_targets));
  return targets;
}

/// In the order of the help.
const std::vector<Key>& keys() {
  constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();
  static const std::vector<Key> all{
      text_key(
          "data", "tournament (every pair of the roster), best-reply, explore, or a folder of .npy files",
          [](auto& c) -> auto& { return c.data; }, any_text),
      text_key(
          "roster", "SPEC of the opponents in the data and in the evaluations",
          [](auto& c) -> auto& { return c.roster; }, any_text),
      {"rounds", "of a match (default 100, of a folder what it holds)",
       [](TrainConfig& c, const std::string& text, const std::string& what) {
         c.rounds = parse_whole_number(text, what, 1, most_rounds);
       },
       [](const TrainConfig& c) { return c.rounds == 0 ? "" : fmt::to_string(c.rounds); }},
      {"payoffs", "a prisoner's dilemma, or those of the game",
       [](TrainConfig& c, const std::string& text, const std::string&) {
         c.payoffs = parse_symmetric_payoffs(text);
         c.payoffs_given = true;
       },
       [](const TrainConfig& c) { return to_text(c.payoffs); }},
      text_key(
          "game", "a symmetric 2x2 game from a .nfg file, its first action taken as C; - is the standard input",
          [](auto& c) -> auto& { return c.game; }, any_text),
      whole_key(
          "data-repetitions", "matches of a pair in the data, where chance has a part", 1, 10'000,
          [](auto& c) -> auto& { return c.data_repetitions; }),
      real_key(
          "regret-temperature",
          "how sharply the policy loss tells good moves of the data from bad ones (0: not at all)", 0, 1e15,
          [](auto& c) -> auto& { return c.regret_temperature; }),
      real_key(
          "situation-temperature", "likewise good situations from spoilt ones; with a regret-temperature", 1e-9, 1e15,
          [](auto& c) -> auto& { return c.situation_temperature; }),
      whole_key(
          "aggregate-every", "steps between matches of the learner that a Bayes-optimal teacher labels (0: none)", 0,
          most_steps, [](auto& c) -> auto& { return c.aggregate_every; }),
      whole_key(
          "aggregate-repetitions", "such matches against each opponent in which the learner slips, beside one without",
          0, 10'000, [](auto& c) -> auto& { return c.aggregate_repetitions; }),
      real_key(
          "aggregate-slip", "each move of the learner flips with this probability in them", 0, 1,
          [](auto& c) -> auto& { return c.aggregate_slip; }),
      text_key(
          "opponents", "SPEC of whom explored matches are against, which may have weights as in 3*sct2025,memory(2,2)",
          [](auto& c) -> auto& { return c.opponents; }, any_text),
      real_key(
          "opponent-slip", "each of their moves slips with this probability, as far as the labels know", 1e-6, 0.25,
          [](auto& c) -> auto& { return c.opponent_slip; }),
      whole_key(
          "explore-every", "steps after which half of the explored matches give way to new ones", 1, most_steps,
          [](auto& c) -> auto& { return c.explore_every; }),
      whole_key(
          "explore-matches", "so many new ones", 1, 100'000, [](auto& c) -> auto& { return c.explore_matches; }),
      text_key(
          "loss", "teacher, selfconf, or the ablations rmadt, madt", [](auto& c) -> auto& { return c.loss; },
          check_loss),
      whole_key(
          "steps", "steps of the optimiser", 1, most_steps, [](auto& c) -> auto& { return c.steps; }),
      whole_key(
          "seed", "of all random numbers of the training", 0, any, [](auto& c) -> auto& { return c.training.seed; }),
      whole_key(
          "hidden", "width of the network", 1, 8192, [](auto& c) -> auto& { return c.training.architecture.hidden; }),
      whole_key(
          "layers", "blocks of the network", 1, 256, [](auto& c) -> auto& { return c.training.architecture.layers; }),
      whole_key(
          "heads", "attention heads of a block; they divide hidden", 1, 8192,
          [](auto& c) -> auto& { return c.training.architecture.heads; }),
      whole_key(
          "context", "rounds of a window", 1, 4096, [](auto& c) -> auto& { return c.training.windows.context; }),
      whole_key(
          "remembered", "rounds that the observation of a round tells of", 1, sct::most_remembered,
          [](auto& c) -> auto& { return c.remembered; }),
      whole_key(
          "time-rows", "rounds that the network tells apart by when they are; later ones are one (0: all)", 0,
          most_rounds, [](auto& c) -> auto& { return c.time_rows; }),
      text_key(
          "return-token", "what the network sees of returns: shown or hidden",
          [](auto& c) -> auto& { return c.return_token; },
          [](const std::string& text, const std::string& what) {
            if (text != "shown" && text != "hidden")
              throw UsageError(fmt::format("{} '{}': expected shown or hidden", what, excerpt(text)));
          }),
      whole_key(
          "plan-depth", "rounds that the policy looks ahead on its beliefs; 0: it moves by its action head", 0,
          sct::most_plan_depth, [](auto& c) -> auto& { return c.plan_depth; }),
      whole_key(
          "batch", "windows of a step", 1, 1'000'000, [](auto& c) -> auto& { return c.training.windows.windows; }),
      real_key(
          "learning-rate", "of AdamW", 0, 1, [](auto& c) -> auto& { return c.training.optimiser.learning_rate; }),
      real_key(
          "weight-decay", "of AdamW", 0, 1000, [](auto& c) -> auto& { return c.training.optimiser.weight_decay; }),
      whole_key(
          "warmup", "steps over which the learning rate rises to its full size", 0, most_steps,
          [](auto& c) -> auto& { return c.training.optimiser.warmup_steps; }),
      text_key(
          "decay", "the learning rate falls along a half cosine to 0 at the last step (yes), at this step, or no",
          [](auto& c) -> auto& { return c.decay; },
          [](const std::string& text, const std::string& what) { decay_steps(text, 1, what); }),
      real_key(
          "clip", "largest norm of the gradient", 1e-12, 1e12,
          [](auto& c) -> auto& { return c.training.optimiser.clip; }),
      real_key(
          "dropout", "probability that a hidden number is dropped in training", 0, 0.99,
          [](auto& c) -> auto& { return c.training.dropout; }),
      real_key(
          "early", "share of the windows that begin in round 1; the rest begin anywhere", 0, 1,
          [](auto& c) -> auto& { return c.training.windows.early; }),
      {"return-scale",
       "returns are divided by it (default 20 times the range of the payoffs, 100 in the usual dilemma)",
       [](TrainConfig& c, const std::string& text, const std::string& what) {
         c.return_scale = parse_number(text, what, 1e-9, 1e15);
       },
       [](const TrainConfig& c) { return c.return_scale == 0 ? "" : fmt::format("{}", c.return_scale); }},
      real_key(
          "return-jitter", "standard deviation of a number added to the returns of a window", 0, 1e15,
          [](auto& c) -> auto& { return c.training.windows.return_jitter; }),
      real_key(
          "averaging", "decay of a moving average of the parameters, which then plays (0: none)", 0, 0.999999,
          [](auto& c) -> auto& { return c.training.averaging; }),
      whole_key(
          "evaluate-every", "steps between evaluations", 1, most_steps,
          [](auto& c) -> auto& { return c.evaluate_every; }),
      {"targets",
       "returns to ask for in the evaluations: FROM:TO:BY or a comma list (default 260:360:20, a round 2.6 "
       "to 3.6, and likewise around what both can have in other games)",
       [](TrainConfig& c, const std::string& text, const std::string& what) {
         parse_targets(text, what);
         c.targets = text;
       },
       [](const TrainConfig& c) { return c.targets; }},
      real_key(
          "validation-noise", "each move flips with this probability in the evaluations", 0, 1,
          [](auto& c) -> auto& { return c.validation_noise; }),
      whole_key(
          "validation-repetitions", "matches against each opponent in an evaluation", 1, 10'000,
          [](auto& c) -> auto& { return c.validation_repetitions; }),
      whole_key(
          "validation-seed", "of the evaluations' random numbers", 0, any,
          [](auto& c) -> auto& { return c.validation_seed; }),
      text_key(
          "held-out",
          "SPEC of opponents of the evaluations that training never meets; what is earned against them decides",
          [](auto& c) -> auto& { return c.held_out; }, any_text),
      whole_key(
          "patience", "evaluations in a row without a higher total after which the run ends (0: it does not)", 0,
          most_steps, [](auto& c) -> auto& { return c.patience; }),
      whole_key(
          "checkpoint-every", "steps between checkpoints", 1, most_steps,
          [](auto& c) -> auto& { return c.checkpoint_every; }),
  };
  return all;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

[[noreturn]] void refuse_key(const std::string& name) {
  for (const char* option : {"config", "output", "log", "seeds", "checkpoint", "resume", "threads", "format", "quiet"})
    if (name == option)
      throw UsageError(fmt::format("unknown key '{}': it is an option of the command line alone", name));
  std::vector<NameCandidate> candidates;
  for (const auto& key : keys()) candidates.push_back({name_key(key.name), key.name});
  const auto near = nearest_names(name, candidates);
  throw UsageError(fmt::format("unknown key '{}'{}; 'sct-train --help' lists them all", excerpt(name),
                               near.empty() ? "" : fmt::format(": did you mean {}?", fmt::join(near, ", "))));
}

/// The game of the file, where there is one; payoffs that are given beside it must be its own.
void take_game(TrainConfig& config) {
  if (!config.has_game()) {
    const auto& [t, r, p, s] = config.payoffs;
    prisoners_dilemma(t, r, p, s);
    return;
  }
  const StageGame game = read_game(config.game);
  const Payoffs payoffs = symmetric_payoffs(game);
  if (config.payoffs_given && !(config.payoffs == payoffs))
    throw UsageError(fmt::format("game {} has {}, which payoffs {} contradict: give one of the two",
                                 excerpt(config.game, 1000), to_text(payoffs), to_text(config.payoffs)));
  config.payoffs = payoffs;
  constexpr std::size_t longest_action = 100;
  for (std::size_t i = 0; i < config.actions.size(); ++i) {
    const std::string& action = game.actions(Seat::first)[i];
    const auto characters = utf8_characters(action);
    if (action.size() > longest_action || std::any_of(characters.begin(), characters.end(), no_character))
      throw UsageError(
          fmt::format("game {}: the action '{}' cannot be kept in a policy: give it a name of at most {} "
                      "bytes of UTF-8",
                      excerpt(config.game, 1000), excerpt(action), longest_action));
    config.actions[i] = action;
  }
}

void take_line(TrainConfig& config, std::string_view line, std::set<std::string>& seen) {
  line = trimmed(line.substr(0, line.find('#')));
  if (line.empty()) return;
  const auto sign = line.find('=');
  if (sign == std::string_view::npos) throw UsageError(fmt::format("'{}': expected key = value", excerpt(line)));
  const std::string name(trimmed(line.substr(0, sign)));
  const auto key = std::find_if(keys().begin(), keys().end(), [&](const Key& k) { return k.name == name; });
  if (key == keys().end()) refuse_key(name);
  if (!seen.insert(name).second) throw UsageError(fmt::format("{} is given twice; give it once", name));
  key->set(config, std::string(trimmed(line.substr(sign + 1))), name);
}

/// The place of a line in messages.
std::string place(const std::filesystem::path& file, std::size_t number) {
  return fmt::format("{}:{}: ", excerpt(file.string(), 1000), number);
}

/// Returns the number of the line that gives the payoffs; 0 where none does.
std::size_t take_file(TrainConfig& config, const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  std::set<std::string> seen;
  std::size_t number = 1;
  std::size_t of_payoffs = 0;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const auto end = std::min(text.find('\n', begin), text.size());
    try {
      take_line(config, std::string_view(text).substr(begin, end - begin), seen);
    } catch (const UsageError& error) {
      throw InputFileError(place(file, number) + error.what());
    }
    if (of_payoffs == 0 && config.payoffs_given) of_payoffs = number;
    begin = end + 1;
  }
  return of_payoffs;
}

}  // namespace

void add_train_options(po::options_description& options) {
  const TrainConfig defaults;
  for (const auto& key : keys()) {
    const auto value = key.show(defaults);
    const auto help = value.empty() ? key.help : fmt::format("{} (default {})", key.help, value);
    options.add_options()(key.name.c_str(), po::value<std::string>(), help.c_str());
  }
}

TrainConfig train_config(const po::variables_map& values, const std::filesystem::path& file) {
  TrainConfig config;
  std::size_t of_payoffs = file.empty() ? 0 : take_file(config, file);
  // Options win over the file: --payoffs over its game, --game over its payoffs.
  const bool by_letters = values.count("payoffs") != 0;
  if (by_letters || values.count("game") != 0) {
    config.payoffs_given = by_letters;
    config.game = TrainConfig{}.game;
    of_payoffs = 0;
  }
  for (const auto& key : keys())
    if (values.count(key.name) != 0) key.set(config, values[key.name].as<std::string>(), "--" + key.name);
  if (config.data_is_folder() && config.data_repetitions != TrainConfig{}.data_repetitions)
    throw UsageError(fmt::format("data-repetitions = {}: the matches of a folder are played already; leave it out",
                                 config.data_repetitions));
  if (config.has_teacher() && config.data_is_folder())
    throw UsageError("a teacher needs matches against its roster: give data = tournament or best-reply");
  if (config.explores() && (config.aggregate_every > 0 || config.regret_temperature > 0))
    throw UsageError("what is explored has labels of its own: leave aggregate-every and regret-temperature out");
  if (config.explores() && config.return_token == "shown")
    throw UsageError("explored matches have no returns to ask for: give return-token = hidden");
  if (config.plan_depth > 0 && config.loss == "madt")
    throw UsageError("plan-depth: there are no beliefs to plan on with loss = madt; leave it out");
  if (config.regret_temperature > 0 && config.data == "best-reply")
    throw UsageError("regret-temperature weighs moves that are imitated; a teacher weighs best replies: leave it out");
  try {
    take_game(config);
  } catch (const UsageError& error) {
    if (of_payoffs == 0) throw;
    throw InputFileError(place(file, of_payoffs) + error.what());
  }
  return config;
}

TrainConfig with_seed(TrainConfig config, std::uint64_t seed) {
  if (config.validation_seed == seed)
    throw UsageError(fmt::format("validation-seed and seed are both {}: evaluations need numbers of their own", seed));
  config.training.seed = seed;
  return config;
}

std::string usual_targets(const Payoffs& payoffs, std::uint64_t rounds) {
  const auto& [t, r, p, s] = payoffs;
  const Rational range = range_of(payoffs);
  const Rational both = std::max({r, p, (t + s) / 2});
  const Rational most = std::max({t, r, p, s});
  const auto of_match = [&](const Rational& a_round) { return to_double(a_round * Rational(rounds)); };
  return fmt::format("{}:{}:{}", of_match(both - range * 2 / 25), of_match(std::min(both + range * 3 / 25, most)),
                     of_match(range / 25));
}

void settle(TrainConfig& config, std::uint64_t rounds) {
  if (config.rounds != 0 && config.rounds != rounds)
    throw UsageError(fmt::format("rounds = {}, but the matches in {} have {}: leave rounds out", config.rounds,
                                 config.data, rounds));
  if (rounds > most_rounds)
    throw UsageError(fmt::format("{}: matches of {} rounds, more than {}", config.data, rounds, most_rounds));
  config.rounds = rounds;
  if (config.targets.empty() && config.return_token == "hidden") config.targets = "0";
  if (config.targets.empty()) config.targets = usual_targets(config.payoffs, rounds);
  constexpr int scale_of_range = 20;  // 100 in the standard dilemma, as the paper's program has it
  if (config.return_scale == 0) config.return_scale = scale_of_range * to_double(range_of(config.payoffs));
  config.training.windows.return_scale = config.return_scale;
}

std::vector<std::pair<std::string, std::string>> key_values(const TrainConfig& config) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const auto& key : keys()) lines.emplace_back(key.name, key.show(config));
  return lines;
}

sct::TrainingSettings training_settings(const TrainConfig& config, unsigned threads) {
  auto settings = config.training;
  auto& architecture = settings.architecture;
  architecture.context = settings.windows.context;
  architecture.observation_size = config.remembered * sct::observation_size;
  settings.windows.shows_return = config.return_token == "shown";
  architecture.time_rows = config.time_rows == 0 ? config.rounds : std::min(config.time_rows, config.rounds);
  settings.mode = config.loss == "selfconf" ? sct::LossMode::selfconf
                  : config.loss == "madt"   ? sct::LossMode::action_only
                                            : sct::LossMode::teacher;
  if (config.loss == "rmadt" || config.loss == "madt") architecture.readout = sct::Readout::own;
  architecture.belief_token = config.loss != "madt";
  settings.optimiser.decay_steps = decay_steps(config.decay, config.steps, "decay");
  settings.threads = threads;
  architecture.check();
  return settings;
}

std::vector<double> targets_of(const TrainConfig& config) { return parse_targets(config.targets, "targets"); }

sct::RunSettings run_settings(const TrainConfig& config, unsigned threads) {
  sct::RunSettings settings;
  settings.steps = config.steps;
  settings.evaluate_every = config.evaluate_every;
  settings.targets = targets_of(config);
  settings.explore_every = config.explore_every;
  settings.explore_matches = config.explore_matches;
  settings.aggregate_every = config.aggregate_every;
  settings.aggregate_repetitions = config.aggregate_repetitions;
  settings.aggregate_slip = config.aggregate_slip;
  settings.patience = config.patience;
  auto& validation = settings.validation;
  validation.payoffs = config.payoffs;
  validation.criterion = Criterion::finite(config.rounds);
  validation.noise = config.validation_noise;
  validation.repetitions = config.validation_repetitions;
  validation.seed = config.validation_seed;
  validation.threads = threads;
  return settings;
}

}  // namespace folk::tools
