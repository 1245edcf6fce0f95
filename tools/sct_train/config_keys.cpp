#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/strategies/names.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/sct_train/config_keys.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace folk::tools {
namespace {

constexpr std::size_t most_targets = 100;

template <class Field>
ConfigKey whole_key(std::string name, std::string help, std::uint64_t low, std::uint64_t high, Field field) {
  const auto set = [=](TrainConfig& config, const std::string& text, const std::string& what) {
    field(config) = parse_whole_number(text, what, low, high);
  };
  return {std::move(name), std::move(help), set,
          [=](const TrainConfig& config) { return fmt::to_string(field(config)); }};
}

template <class Field>
ConfigKey real_key(std::string name, std::string help, double low, double high, Field field) {
  const auto set = [=](TrainConfig& config, const std::string& text, const std::string& what) {
    field(config) = parse_number(text, what, low, high);
  };
  return {std::move(name), std::move(help), set,
          [=](const TrainConfig& config) { return fmt::format("{}", field(config)); }};
}

/// `check` throws UsageError for a text that the key cannot have; its second argument names the key.
template <class Field, class Check>
ConfigKey text_key(std::string name, std::string help, Field field, Check check) {
  const auto set = [=](TrainConfig& config, const std::string& text, const std::string& what) {
    if (text.empty()) throw UsageError(fmt::format("{} '': expected a value", what));
    check(text, what);
    field(config) = text;
  };
  return {std::move(name), std::move(help), set, [=](const TrainConfig& config) { return field(config); }};
}

void any_text(const std::string&, const std::string&) {}

void check_loss(const std::string& text, const std::string& what) {
  if (text != "teacher" && text != "selfconf" && text != "rmadt" && text != "madt")
    throw UsageError(fmt::format("{} '{}': expected teacher, selfconf, rmadt or madt", what, excerpt(text)));
}

}  // namespace

std::uint64_t decay_steps(const std::string& text, std::uint64_t all, const std::string& what) {
  if (text == "no") return 0;
  if (text == "yes") return all;
  const std::uint64_t number = whole_number(text).value_or(0);
  if (number == 0 || number > most_training_steps)
    throw UsageError(fmt::format("{} '{}': expected yes, no or a number of steps", what, excerpt(text)));
  return number;
}

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

const std::vector<ConfigKey>& config_keys() {
  constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();
  static const std::vector<ConfigKey> all{
      text_key(
          "data", "tournament (every pair of the roster), best-reply, explore, or a folder of .npy files",
          [](auto& c) -> auto& { return c.data; }, any_text),
      text_key(
          "roster", "SPEC of the opponents in the data and in the evaluations",
          [](auto& c) -> auto& { return c.roster; }, any_text),
      {"rounds", "of a match (default 100, of a folder what it holds)",
       [](TrainConfig& c, const std::string& text, const std::string& what) {
         c.rounds = parse_whole_number(text, what, 1, most_training_rounds);
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
          most_training_steps, [](auto& c) -> auto& { return c.aggregate_every; }),
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
          "explore-every", "steps after which half of the explored matches give way to new ones", 1,
          most_training_steps, [](auto& c) -> auto& { return c.explore_every; }),
      whole_key(
          "explore-matches", "so many new ones", 1, 100'000, [](auto& c) -> auto& { return c.explore_matches; }),
      text_key(
          "loss", "teacher, selfconf, or the ablations rmadt, madt", [](auto& c) -> auto& { return c.loss; },
          check_loss),
      whole_key(
          "steps", "steps of the optimiser", 1, most_training_steps, [](auto& c) -> auto& { return c.steps; }),
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
          most_training_rounds, [](auto& c) -> auto& { return c.time_rows; }),
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
          "warmup", "steps over which the learning rate rises to its full size", 0, most_training_steps,
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
          "evaluate-every", "steps between evaluations", 1, most_training_steps,
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
          most_training_steps, [](auto& c) -> auto& { return c.patience; }),
      whole_key(
          "checkpoint-every", "steps between checkpoints", 1, most_training_steps,
          [](auto& c) -> auto& { return c.checkpoint_every; }),
  };
  return all;
}

}  // namespace folk::tools
