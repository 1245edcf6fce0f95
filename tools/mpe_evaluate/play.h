#pragma once
// Episodes of the particle world, scored: predators against one prey after another.

#include <folk/games/progress.h>
#include <folk/mpe/evaluation/beliefs.h>
#include <folk/mpe/evaluation/episode_record.h>
#include <folk/mpe/evaluation/scores.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// What is played, with every default filled in.
struct EvaluationSettings {
  mpe::Scenario scenario;
  std::string predators;
  std::vector<std::string> preys;
  mpe::EpisodePlan plan;
  std::optional<std::uint32_t> numpy_seed;  ///< of numpy's generator where that placed everything

  /// Where references come from; nothing: published for the released prey, measured for any other.
  std::optional<mpe::ReferenceSource> source;
  mpe::References given;  ///< those of a source that is `given`

  std::filesystem::path data;  ///< the shipped players

  // Of predators that are a transformer's policy file:
  std::vector<double> targets;       ///< returns of which each prey's best is asked for; empty: the policy's own
  std::uint64_t selection_seed = 2;  ///< of the episodes on which the best is found
  bool beliefs = false;              ///< say how often they are right
  bool forced_beliefs = false;       ///< say what becomes of the play when they are forced
};

/// What is said of a transformer's beliefs and of the returns that it is asked for.
struct TransformerResult {
  double target = 0;                          ///< that was asked for
  std::vector<mpe::TargetScore> targets;      ///< all that were tried
  std::optional<mpe::BeliefSummary> beliefs;  ///< of a policy that believes
  std::vector<mpe::ForcingScore> forced;
};

/// What came of one prey.
struct PreyResult {
  std::string prey;
  std::vector<mpe::EpisodeScore> episodes;
  mpe::ScoreSummary summary;
  mpe::References references;
  std::optional<double> score;  ///< normalised
  std::optional<TransformerResult> transformer;
};

struct Evaluation {
  std::string predators;
  std::shared_ptr<const mpe::TransformerMind> mind;  ///< of a transformer
  std::vector<PreyResult> results;
  std::vector<std::string> notes;  ///< what a reader must know
  std::uint64_t signature = 0;     ///< over the returns of all episodes
};

/// Plays the episodes; references are measured over the same ones. Makes every player before anything is played, and
/// throws what controller and score_episodes throw.
Evaluation evaluate(const EvaluationSettings& settings, const Progress& progress);

/// Plays one episode once more, against the first prey, and writes it down. A player that is a program may play it
/// otherwise: `evaluation` gets a note then.
mpe::EpisodeRecord record_again(const EvaluationSettings& settings, std::size_t episode, Evaluation& evaluation);

}  // namespace folk::tools
