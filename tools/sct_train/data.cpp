#include <folk/games/outcome.h>
#include <folk/sct/data/recorded_play.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/sct_train/data.h>

#include <fmt/format.h>
#include <folk/analysis/play/signature.h>
#include <folk/analysis/replies/bayes_player.h>
#include <folk/analysis/replies/opponent_prior.h>
#include <folk/games/error.h>
#include <folk/sct/data/data_folder.h>
#include <folk/sct/data/regret_weights.h>
#include <folk/sct/data/tournament_data.h>

#include <algorithm>
#include <cmath>

namespace folk::tools {
namespace {

/// Rounds of matches that are played for a run, unless its config says another number.
constexpr std::uint64_t usual_rounds = 100;

/// The moves must have earned what the game of the evaluations pays for them.
void check_rewards(const std::vector<sct::Trajectory>& data, const TrainConfig& config) {
  const auto payoffs = config.payoffs.numbers();
  for (std::size_t i = 0; i < data.size(); ++i)
    for (std::size_t t = 0; t < data[i].rounds(); ++t) {
      const double payoff = payoffs[Outcome{data[i].own[t], data[i].theirs[t]}.index()];
      if (std::abs(data[i].rewards[t] - payoff) > 1e-4 * std::max(1.0, std::abs(payoff)))
        throw InputFileError(fmt::format("{}: the reward at [{}, {}] is {}, where {} pays {}; give the data's payoffs",
                                         excerpt(config.data, 1000), i, t, data[i].rewards[t], to_text(config.payoffs),
                                         payoff));
    }
}

std::vector<sct::Trajectory> trajectories_of(TrainConfig& config, const std::vector<Strategy>& roster) {
  if (config.data_is_folder()) {
    auto data = sct::read_data_folder(config.data);
    settle(config, data.front().rounds());
    check_rewards(data, config);
    return data;
  }
  settle(config, config.rounds == 0 ? usual_rounds : config.rounds);
  return sct::tournament_data(roster, config.payoffs, config.rounds, config.data_repetitions, config.training.seed);
}

/// The data that the paper's theory assumes: replies that are best to the roster, and what comes of slips on the way.
std::vector<sct::Trajectory> best_replies(const TrainConfig& config, const std::vector<Strategy>& roster) {
  auto data = sct::best_reply_data(roster, config.payoffs, config.rounds);
  const auto bayes = bayes_strategy("bayes", roster, std::nullopt);
  for (const double slip : {0.0, 0.02, 0.05, 0.1, 0.2})
    for (auto& match : sct::play_and_record(bayes, roster, config.payoffs, config.rounds, slip, config.data_repetitions,
                                            config.training.seed))
      data.push_back(std::move(match));
  return data;
}

}  // namespace

TrainData train_data(TrainConfig& config, const std::vector<Strategy>& roster) {
  const bool best_reply = config.data == "best-reply";
  TrainData train;
  if (config.explores()) {
    settle(config, config.rounds == 0 ? usual_rounds : config.rounds);
    auto prior = read_prior(standard_names(), config.met(), config.payoffs);
    prior.slip = config.opponent_slip;
    for (const auto& known : prior.known) train.opponents.insert(known.strategy.name);
    train.exploration = std::make_shared<const sct::Exploration>(std::move(prior), config.payoffs, config.rounds);
    return train;
  }
  std::vector<sct::Trajectory> data;
  const auto hire_teacher = [&] {
    train.teacher =
        std::make_shared<const sct::BayesTeacher>(roster, config.payoffs, config.rounds, targets_of(config).front());
  };
  if (best_reply) {
    settle(config, config.rounds == 0 ? usual_rounds : config.rounds);
    hire_teacher();  // first: it refuses a roster that nobody has a best reply to
    data = best_replies(config, roster);
  } else {
    data = trajectories_of(config, roster);
    if (config.has_teacher()) hire_teacher();
  }
  train.lessons.reserve(data.size());
  for (const auto& trajectory : data)
    train.lessons.push_back(best_reply ? train.teacher->label(trajectory) : sct::imitation(trajectory));
  for (const auto& trajectory : data) train.opponents.insert(trajectory.opponent);
  if (config.regret_temperature > 0 && train.opponents.contains(""))
    throw UsageError(fmt::format(
        "regret-temperature weighs moves opponent by opponent, and {} does not name them: add names.json, or "
        "leave regret-temperature out",
        excerpt(config.data, 1000)));
  if (config.regret_temperature > 0)
    sct::weigh_by_regret(data, {config.regret_temperature, config.situation_temperature}, train.lessons);
  return train;
}

std::uint64_t signature_of(const std::vector<sct::Lesson>& lessons) {
  Signature signature;
  for (const auto& lesson : lessons)
    for (std::size_t t = 0; t < lesson.rounds(); ++t) {
      signature.add(std::uint64_t{lesson.observations[t]} | std::uint64_t{lesson.opponent[t]} << 8U |
                    std::uint64_t{lesson.own[t]} << 16U | std::uint64_t{lesson.wanted[t]} << 24U);
      signature.add(static_cast<double>(lesson.weights[t]));
      signature.add(static_cast<double>(lesson.returns[t]));
    }
  signature.add(std::uint64_t{lessons.size()});
  return signature.value();
}

}  // namespace folk::tools
