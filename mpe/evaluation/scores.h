#pragma once
// What many episodes say about their players: means with their uncertainty, and the normalised score of the field.

#include <folk/games/progress.h>
#include <folk/mpe/evaluation/episodes.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace folk::mpe {

/// A mean over independent episodes and how sure it is. Of a single episode the last three are NaN.
struct Estimate {
  double mean = 0;
  double deviation = 0;       ///< standard deviation of an episode (n - 1)
  double standard_error = 0;  ///< of the mean
  double ci95 = 0;            ///< half the width of the mean's 95 % interval (Student's t)
};

/// Throws UsageError when there is no value.
Estimate estimate(std::span<const double> values);

/// The scores of some episodes, averaged.
struct ScoreSummary {
  std::size_t episodes = 0;
  Estimate predators;  ///< the return of one predator, S
  EpisodeScore means;
};
ScoreSummary summarise(std::span<const EpisodeScore> scores);

/// Where the two returns between which a score is placed come from.
enum class ReferenceSource { published, measured, given };

/// The returns that count as 100 and as 0.
struct References {
  std::optional<double> expert;  ///< nothing where there is no expert to measure
  double random = 0;
  ReferenceSource source = ReferenceSource::measured;
};

/// Those of the field's tables: (185.6, -4.1) in simple_tag, (79.5, -6.8) in simple_world, against the released prey
/// (Pan, Huang, Ma & Xu, "Plan Better Amid Conservatism", ICML 2022; Li et al., arXiv 2310.04579). Throws UsageError
/// for another scenario or rewards by the paper's text, for which none were published.
References published_references(const Scenario& scenario);

/// Those of an expert (or none) and of uniformly random predators against a prey, over the planned episodes.
References measured_references(const Layout& layout, const std::optional<Controller>& expert, const Controller& prey,
                               const EpisodePlan& plan, const Progress& progress = nullptr);

/// 100 (S - S_random) / (S_expert - S_random); nothing without an expert or when it earns what random play does.
std::optional<double> normalised_score(double predators_return, const References& references);

/// A 64-bit signature of the returns of all episodes, predators' and prey's, in their order.
std::uint64_t signature(std::span<const EpisodeScore> scores);

std::string_view to_string(ReferenceSource source);

}  // namespace folk::mpe
