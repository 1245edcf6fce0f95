#include <folk/tools/mpe_evaluate/play.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/players/any_policy.h>
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
  Pieces(std::size_t pieces, const Progress& progress)
      : pieces_(static_cast<double>(pieces)),
        progress_(progress) {}

  /// The progress of the next piece, which weighs `weight`.
  Progress next(double weight) {
    const double begin = done_;
    done_ += weight;
    return progress_.part(begin / pieces_, done_ / pieces_);
  }

private:
  double pieces_;
  double done_ = 0;
  const Progress& progress_;
};

/// The mind of a transformer's policy file; null for all other players, and for a pipe, which can be read but once.
std::shared_ptr<const mpe::TransformerMind> transformer_of(const Controller& predators) {
  std::error_code ignored;
  if (!fs::is_regular_file(predators.file, ignored)) return nullptr;
  const std::string bytes = read_file(predators.file, mpe::largest_policy_file);
  if (!mpe::is_transformer(bytes, predators.file)) return nullptr;
  return std::make_shared<const mpe::TransformerMind>(mpe::parse_transformer_policy(bytes, predators.file));
}

/// Refuses what only transformers can be asked.
void require_transformer(const EvaluationSettings& settings, const Evaluation& evaluation,
                         const std::vector<Opponent>& preys) {
  const auto refuse = [&](const char* option, const char* what) {
    throw UsageError(fmt::format("{}: {} {}; give --predators the file of another policy, or leave it out", option,
                                 excerpt(evaluation.predators, 1000), what));
  };
  const auto& mind = evaluation.mind;
  if (!settings.targets.empty() && !mind) refuse("--targets", "is no transformer and cannot be asked for a return");
  if (settings.beliefs && (!mind || !mind->believes())) refuse("--beliefs", "has no beliefs");
  if (!settings.forced_beliefs) return;
  if (!mind || !mind->believes() || !mind->acts_on_belief()) refuse("--force-beliefs", "does not act on beliefs");
  for (const auto& prey : preys)
    if (prey.controller.one_by_one)
      throw UsageError(fmt::format("--force-beliefs: what {} will do cannot be known; name a player of Folk",
                                   excerpt(prey.name, 1000)));
}

void play_transformer(const EvaluationSettings& settings, const mpe::Layout& layout,
                      const std::shared_ptr<const mpe::TransformerMind>& mind, const Controller& prey, Pieces& pieces,
                      PreyResult& result) {
  TransformerResult transformer;
  transformer.target = mind->policy.return_target;
  if (!settings.targets.empty()) {
    mpe::EpisodePlan selection = settings.plan;
    selection.seed = settings.selection_seed;
    selection.place = nullptr;
    transformer.targets = mpe::score_targets(layout, mind, prey, selection, settings.targets,
                                             pieces.next(static_cast<double>(settings.targets.size())));
    transformer.target = mpe::best_target(transformer.targets);
  }
  mpe::TransformerPlay play;
  play.target = transformer.target;
  auto scores = mpe::score_transformer(layout, mind, prey, settings.plan, play, pieces.next(1));
  if (mind->believes()) transformer.beliefs = mpe::summarise(std::span<const mpe::EpisodeBeliefs>(scores.beliefs));
  if (settings.forced_beliefs)
    transformer.forced = mpe::force_beliefs(layout, mind, prey, settings.plan, play,
                                            pieces.next(static_cast<double>(mpe::belief_forcings.size())));
  result.episodes = std::move(scores.play);
  result.transformer = std::move(transformer);
}

}  // namespace

Evaluation evaluate(const EvaluationSettings& settings, const Progress& progress) {
  const mpe::Layout layout(settings.scenario);
  const Controller predators = player(settings, settings.predators, mpe::Side::predators);
  const auto preys = opponents(settings);
  Evaluation evaluation;
  evaluation.predators = predators.name;
  evaluation.mind = transformer_of(predators);
  require_transformer(settings, evaluation, preys);
  const auto measured = static_cast<std::size_t>(std::count_if(
      preys.begin(), preys.end(), [](const auto& prey) { return prey.source == ReferenceSource::measured; }));
  const auto expert = measured > 0 ? shipped_expert(settings, evaluation.notes) : std::nullopt;
  const std::size_t references = expert ? 2 : 1;
  const std::size_t plays = 1 + settings.targets.size() + (settings.forced_beliefs ? mpe::belief_forcings.size() : 0);
  Pieces pieces(plays * preys.size() + references * measured, progress);
  for (const auto& prey : preys) {
    PreyResult result;
    result.prey = prey.name;
    if (evaluation.mind)
      play_transformer(settings, layout, evaluation.mind, prey.controller, pieces, result);
    else
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
  mpe::Cast cast{player(settings, settings.predators, mpe::Side::predators),
                 player(settings, settings.preys.front(), mpe::Side::prey)};
  if (evaluation.mind) {
    mpe::TransformerPlay play;
    play.target = evaluation.results.front().transformer->target;
    cast.predators = mpe::transformer_controller(evaluation.predators, evaluation.mind, settings.scenario, play);
  }
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
