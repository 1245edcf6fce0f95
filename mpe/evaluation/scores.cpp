#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>
#include <folk/mpe/evaluation/scores.h>
#include <folk/mpe/players/scripted.h>

#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace folk::mpe {
namespace {

std::vector<double> predators_returns(std::span<const EpisodeScore> scores) {
  std::vector<double> returns;
  for (const auto& score : scores) returns.push_back(score.predators);
  return returns;
}

}  // namespace

Estimate estimate(std::span<const double> values) {
  if (values.empty()) throw UsageError("a mean of no values: ask for at least one episode");
  const double count = static_cast<double>(values.size());
  Estimate result;
  for (const double value : values) result.mean += value;
  result.mean /= count;
  if (values.size() == 1) {
    result.deviation = result.standard_error = result.ci95 = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / (count - 1));
  result.standard_error = result.deviation / std::sqrt(count);
  result.ci95 = result.standard_error * boost::math::quantile(boost::math::students_t(count - 1), 0.975);
  return result;
}

ScoreSummary summarise(std::span<const EpisodeScore> scores) {
  ScoreSummary summary;
  summary.episodes = scores.size();
  summary.predators = estimate(predators_returns(scores));
  for (double EpisodeScore::*const part :
       {&EpisodeScore::predators, &EpisodeScore::prey, &EpisodeScore::contacts, &EpisodeScore::caught_steps,
        &EpisodeScore::distance, &EpisodeScore::nearest, &EpisodeScore::outside_steps}) {
    for (const auto& score : scores) summary.means.*part += score.*part;
    summary.means.*part /= static_cast<double>(scores.size());
  }
  return summary;
}

References published_references(const Scenario& scenario) {
  if (scenario.rewards.rule != RewardRule::program)
    throw UsageError("published references are for the program's rewards, not those of the paper's text");
  if (scenario.name == "simple_tag") return {185.6, -4.1, ReferenceSource::published};
  if (scenario.name == "simple_world") return {79.5, -6.8, ReferenceSource::published};
  throw UsageError(fmt::format("no references were published for scenario '{}'", excerpt(scenario.name)));
}

References measured_references(const Layout& layout, const std::optional<Controller>& expert, const Controller& prey,
                               const EpisodePlan& plan, const Progress& progress) {
  const double share = expert ? 0.5 : 1.0;
  const auto measure = [&](const Controller& predators, double done) {
    const auto scores = score_episodes(layout, {predators, prey}, plan, progress.part(done, done + share));
    return estimate(predators_returns(scores)).mean;
  };
  References references;
  references.random = measure(random_player(), 0);
  if (expert) references.expert = measure(*expert, share);
  return references;
}

std::optional<double> normalised_score(double predators_return, const References& references) {
  if (!references.expert || !(std::abs(*references.expert - references.random) > 0)) return std::nullopt;
  return 100 * (predators_return - references.random) / (*references.expert - references.random);
}

std::uint64_t signature(std::span<const EpisodeScore> scores) {
  Signature all;
  for (const auto& score : scores) {
    all.add(score.predators);
    all.add(score.prey);
  }
  return all.value();
}

std::string_view to_string(ReferenceSource source) {
  switch (source) {
    case ReferenceSource::published: return "published";
    case ReferenceSource::measured: return "measured";
    case ReferenceSource::given: break;
  }
  return "given";
}

}  // namespace folk::mpe
