#include "mpe_evaluate_play.h"

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/players/names.h>
#include <folk/mpe/players/policy_file.h>

#include <algorithm>
#include <system_error>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;
using mpe::Controller;
using mpe::ReferenceSource;

Controller player(const EvaluationSettings& settings, const std::string& name, mpe::Side side) {
  return mpe::controller(name, side, settings.scenario, settings.data);
}

/// True for the released prey by its name or by a file of the same bytes.
bool is_released(const EvaluationSettings& settings, const Controller& controller) {
  if (controller.name == "released") return true;
  std::error_code error;
  if (controller.file.empty()) return false;
  const fs::path shipped = settings.data / fmt::format("{}_released.safetensors", settings.scenario.name);
  return fs::exists(shipped, error) &&
         read_file(controller.file, mpe::largest_policy_file) == read_file(shipped, mpe::largest_policy_file);
}

/// The shipped expert; where it cannot be had, a note says so and there is no score.
std::optional<Controller> shipped_expert(const EvaluationSettings& settings, std::vector<std::string>& notes) {
  try {
    return player(settings, "expert", mpe::Side::predators);
  } catch (const InputFileError& error) {
    notes.push_back(fmt::format("no normalised score with measured references: {}", error.what()));
    return std::nullopt;
  }
}

/// A prey that is to be met.
struct Opponent {
  std::string name;
  Controller controller;
  ReferenceSource source;
};

std::vector<Opponent> opponents(const EvaluationSettings& settings) {
  std::vector<Opponent> all;
  for (const auto& name : settings.preys) {
    Controller prey = player(settings, name, mpe::Side::prey);
    const bool program_rewards = settings.scenario.rewards.rule == mpe::RewardRule::program;
    const auto own =
        program_rewards && is_released(settings, prey) ? ReferenceSource::published : ReferenceSource::measured;
    if (std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.name == prey.name; }))
      throw UsageError(fmt::format("--prey: '{}' is given twice; leave one out", excerpt(prey.name)));
    all.push_back({prey.name, prey, settings.source.value_or(own)});
  }
  return all;
}

std::uint64_t signature_of(const std::vector<PreyResult>& results) {
  std::vector<mpe::EpisodeScore> all;
  for (const auto& result : results) all.insert(all.end(), result.episodes.begin(), result.episodes.end());
  return mpe::signature(all);
}

/// Shares of several pieces of work as a share of the whole.
class Pieces {
public:
  Pieces(std::size_t pieces, const std::function<void(double)>& progress)
      : pieces_(static_cast<double>(pieces)),
        progress_(progress) {}

  /// The progress of the next piece, which weighs `weight`.
  std::function<void(double)> next(double weight) {
    const double begin = done_;
    done_ += weight;
    return [this, begin, weight](double share) { progress_((begin + weight * share) / pieces_); };
  }

private:
  double pieces_;
  double done_ = 0;
  const std::function<void(double)>& progress_;
};

}  // namespace

Evaluation evaluate(const EvaluationSettings& settings, const std::function<void(double)>& progress) {
  const mpe::Layout layout(settings.scenario);
  const Controller predators = player(settings, settings.predators, mpe::Side::predators);
  const auto preys = opponents(settings);
  Evaluation evaluation;
  evaluation.predators = predators.name;
  const auto measured = static_cast<std::size_t>(std::count_if(
      preys.begin(), preys.end(), [](const auto& prey) { return prey.source == ReferenceSource::measured; }));
  const auto expert = measured > 0 ? shipped_expert(settings, evaluation.notes) : std::nullopt;
  const std::size_t references = expert ? 2 : 1;
  Pieces pieces(preys.size() + references * measured, progress);
  for (const auto& prey : preys) {
    PreyResult result;
    result.prey = prey.name;
    result.episodes = score_episodes(layout, {predators, prey.controller}, settings.plan, pieces.next(1));
    result.summary = mpe::summarise(result.episodes);
    switch (prey.source) {
      case ReferenceSource::published: result.references = mpe::published_references(settings.scenario); break;
      case ReferenceSource::given: result.references = settings.given; break;
      case ReferenceSource::measured:
        result.references = mpe::measured_references(layout, expert, prey.controller, settings.plan,
                                                     pieces.next(static_cast<double>(references)));
    }
    result.score = mpe::normalised_score(result.summary.predators.mean, result.references);
    evaluation.results.push_back(std::move(result));
  }
  evaluation.signature = signature_of(evaluation.results);
  return evaluation;
}

mpe::EpisodeRecord record_again(const EvaluationSettings& settings, std::size_t episode, Evaluation& evaluation) {
  const mpe::Cast cast{player(settings, settings.predators, mpe::Side::predators),
                       player(settings, settings.preys.front(), mpe::Side::prey)};
  mpe::EpisodePlan plan = settings.plan;
  plan.first += episode;
  auto record = mpe::record_episode(mpe::Layout(settings.scenario), cast, plan);
  double sum = 0;
  for (const auto& row : record.rows) sum += row.rewards.front();
  if (const double scored = evaluation.results.front().episodes[episode].predators; sum != scored)
    evaluation.notes.push_back(fmt::format(
        "episode {} was played again to be recorded and went otherwise: {} instead of {}; a player that is a program "
        "remembered earlier episodes or drew its own random numbers",
        episode, sum, scored));
  return record;
}

}  // namespace folk::tools
