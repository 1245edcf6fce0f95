#pragma once
// The paper's study as a list of jobs: which learner on which data, with which seed, and how each is examined.

#include <folk/mpe/offline/learners.h>
#include <folk/mpe/world/scenario.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// One training and its examination, or the examination of a player that learns nothing. All words are those of the
/// study's files.
struct StudyJob {
  std::string data_prey;  ///< who played the prey in the data: "released" (the paper's) or "maddpg" (trained longer)
  std::string scenario;   ///< "simple_tag" or "simple_world"
  std::string level;      ///< of the data: "expert", "medium" or "random"; "none" for players without data
  std::string learner;  ///< "omar", "bc", "ma-bcq", "madt", "rmadt", "sct", "sct-selfconf"; or a player, see players()
  std::uint64_t seed = 1;

  /// "released-simple_tag-expert-sct-1"
  std::string name() const;
  /// The data set that it learns from: "released-simple_tag-expert".
  std::string data() const;
  bool learns() const;
  bool transformer() const;

  bool operator==(const StudyJob&) const = default;
};

/// "simple_tag" and "simple_world".
const std::vector<std::string>& study_scenarios();
/// The learners of the paper's table in its order, then sct trained by the paper's own loss.
const std::vector<std::string>& study_learners();
/// Who is examined beside them: "matd3" (who made the data), "lead_pursuit" (a rule), "random_play".
const std::vector<std::string>& study_players();

/// The preys of the paper's score table, by the names of mpe/players/names.h.
const std::vector<std::string>& table_preys();
/// Those of the blend curve: blend(p) with p = 1 (released), 0.7, 0.5, 0.3 and 0 (random).
struct BlendPrey {
  double p = 0;
  std::string prey;
};
const std::vector<BlendPrey>& blend_preys();
/// All of them, each once.
const std::vector<std::string>& study_preys();

/// How much is done.
struct StudySettings {
  Budget budget = Budget::small;
  std::size_t transitions = 1'000'000;      ///< of a data set
  std::size_t episodes = 512;               ///< of a reported score
  std::size_t player_episodes = 8'192;      ///< of a player's that learns nothing: scores are held against them
  std::size_t selection_episodes = 96;      ///< of a target's score
  std::size_t intervention_episodes = 192;  ///< of a forced belief
  std::uint64_t seeds = 3;                  ///< of each learner; levels of which one is enough have one

  static StudySettings of(Budget budget, std::uint64_t seeds = 3);
};

/// Seeds of episodes, to all but the first of which the job's seed is added: no training, selection or report shares
/// one, and jobs of the same seed are examined over the same episodes.
inline constexpr std::uint64_t data_seed = 1;
inline constexpr std::uint64_t selection_seed = 20'261'000;
inline constexpr std::uint64_t report_seed = 20'262'000;
inline constexpr std::uint64_t intervention_seed = 20'263'000;

/// The returns that a transformer is asked for: seven of the published program's 0, 20, ..., 480, as far as the
/// scenario's returns go.
std::vector<double> target_grid(const StudyJob& job);

/// Words that choose jobs: a job is chosen when each of its properties of which a word is given has one of them.
/// `only`: "sct,madt,simple_tag,expert"; empty: all. Throws UsageError for a word that no job of the study has.
std::vector<StudyJob> study_jobs(const StudySettings& settings, const std::vector<std::string>& only = {});

/// What a job trains.
LearnerChoice choice_of(const StudyJob& job, const StudySettings& settings);

}  // namespace folk::mpe
