#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/games/utf8.h>
#include <folk/strategies/names.h>
#include <folk/strategies/nearest_names.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/sct_train/config.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace folk::tools {
namespace {

/// From the least to the largest payoff. Throws UsageError where there is no difference to learn from.
Rational range_of(const Payoffs& payoffs) {
  const auto& [t, r, p, s] = payoffs;
  const auto [least, most] = std::minmax({t, r, p, s});
  if (least == most) throw UsageError(fmt::format("in {} no move earns more than another", to_text(payoffs)));
  return most - least;
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
  for (const auto& key : config_keys()) candidates.push_back({name_key(key.name), key.name});
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
  const auto key =
      std::find_if(config_keys().begin(), config_keys().end(), [&](const ConfigKey& k) { return k.name == name; });
  if (key == config_keys().end()) refuse_key(name);
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
  for (const auto& key : config_keys()) {
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
  for (const auto& key : config_keys())
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
  if (rounds > most_training_rounds)
    throw UsageError(fmt::format("{}: matches of {} rounds, more than {}", config.data, rounds, most_training_rounds));
  config.rounds = rounds;
  if (config.targets.empty() && config.return_token == "hidden") config.targets = "0";
  if (config.targets.empty()) config.targets = usual_targets(config.payoffs, rounds);
  constexpr int scale_of_range = 20;  // 100 in the standard dilemma, as the paper's program has it
  if (config.return_scale == 0) config.return_scale = scale_of_range * to_double(range_of(config.payoffs));
  config.training.windows.return_scale = config.return_scale;
}

std::vector<std::pair<std::string, std::string>> key_values(const TrainConfig& config) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const auto& key : config_keys()) lines.emplace_back(key.name, key.show(config));
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
