#pragma once
// A transformer's beliefs put to the test: how often they are right, and what becomes of the play when they are
// exchanged.

#include <folk/games/progress.h>
#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/evaluation/scores.h>
#include <folk/mpe/players/transformer_player.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace folk::mpe {

/// A belief b of the prey's action a is right at radius r when |b - a| < r max(|a|, belief_floor), Euclidean. The
/// paper's accuracy is printed as that of radius 0.1 with |a| alone, which calls every belief about a still prey wrong,
/// as an action of zero leaves no room; here actions below a tenth of the full force count as a tenth. Its numbers do
/// not come from that formula: nothing can foresee a random action within 10 % in 30 % of the steps. An absolute radius
/// of 0.6 explains them (of a random action it covers 0.28 whatever is believed near the middle); that it is the one is
/// our inference.
inline constexpr std::array belief_radii{0.05, 0.1, 0.2, 0.5};
inline constexpr std::size_t paper_radius = 1;  ///< its place among them
inline constexpr double belief_floor = 0.1;
inline constexpr std::array absolute_radii{0.1, 0.3, 0.6};

/// Of one episode: shares of its steps, and means over them.
struct EpisodeBeliefs {
  std::array<double, belief_radii.size()> right{};     ///< share of steps at each radius
  std::array<double, absolute_radii.size()> within{};  ///< share of steps with |b - a| below each absolute radius
  double distance = 0;                                 ///< mean of |b - a|
  double change = 0;  ///< mean change of the own actions where beliefs are forced (ThoughtRecord)
};

/// What a transformer did in some episodes, one entry each.
struct TransformerScores {
  std::vector<EpisodeScore> play;
  std::vector<EpisodeBeliefs> beliefs;
};

/// Plays them. `prey` must be a player of Folk where play.forcing asks what it will do; play.prey is set to it and
/// play.witness is taken by this function.
TransformerScores score_transformer(const Layout& layout, const std::shared_ptr<const TransformerMind>& mind,
                                    const Controller& prey, const EpisodePlan& plan, TransformerPlay play,
                                    const Progress& progress = nullptr);

/// Estimates over the episodes.
struct BeliefSummary {
  std::array<Estimate, belief_radii.size()> right;
  std::array<Estimate, absolute_radii.size()> within;
  Estimate distance, change;
};
BeliefSummary summarise(std::span<const EpisodeBeliefs> beliefs);

/// A return that is asked for, what it earns, and how right the beliefs are that it makes.
struct TargetScore {
  double target = 0;
  Estimate predators;
  std::optional<BeliefSummary> beliefs;  ///< of those who believe
};

/// Plays the planned episodes once for each target. The same episodes each time, so that differences are of the target.
std::vector<TargetScore> score_targets(const Layout& layout, const std::shared_ptr<const TransformerMind>& mind,
                                       const Controller& prey, const EpisodePlan& plan, std::span<const double> targets,
                                       const Progress& progress = nullptr);

/// The target with the highest mean, of equals the first. Throws UsageError when there is none.
double best_target(std::span<const TargetScore> scores);

/// The ways of forcing that are compared, the own belief first.
inline constexpr std::array belief_forcings{BeliefForcing::none, BeliefForcing::truth, BeliefForcing::other_episode,
                                            BeliefForcing::zero};

/// What became of the play when beliefs were forced, held against the same episodes on the own beliefs.
struct ForcingScore {
  BeliefForcing forcing = BeliefForcing::none;
  Estimate predators;
  Estimate difference;  ///< of the return from that of `none`, episode by episode
  Estimate change;      ///< of the actions, as ThoughtRecord has it
};

/// Plays the planned episodes once for each forcing, `none` first. `play.target` is asked for. Throws what
/// score_transformer throws, and UsageError where the last block would have one episode and no other to believe in.
std::vector<ForcingScore> force_beliefs(const Layout& layout, const std::shared_ptr<const TransformerMind>& mind,
                                        const Controller& prey, const EpisodePlan& plan, const TransformerPlay& play,
                                        const Progress& progress = nullptr);

}  // namespace folk::mpe
