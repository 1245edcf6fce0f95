#include <folk/games/error.h>
#include <folk/mpe/evaluation/beliefs.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk::mpe {
namespace {

/// What is believed and changed in the present step of each planned episode; blocks write to places of their own.
struct Thoughts {
  std::uint64_t first;
  std::vector<ThoughtRecord> records;

  ThoughtRecord& of(std::uint64_t episode) { return records[episode - first]; }
};

/// The progress of the next of several equal stages.
Progress one_of(std::size_t done, std::size_t stages, const Progress& progress) {
  const auto all = static_cast<double>(stages);
  return progress.part(static_cast<double>(done) / all, static_cast<double>(done + 1) / all);
}

class BeliefWatcher final : public Watcher {
public:
  BeliefWatcher(Thoughts& thoughts, EpisodeScore* play, EpisodeBeliefs* beliefs)
      : thoughts_(thoughts),
        scorer_(scoring(play)),
        beliefs_(beliefs) {}

  void acted(const Layout& layout, const Block& block, const Moment& moment) override {
    const auto [x, y] = action_rows(block, layout.scenario().prey());
    const double share = 1.0 / static_cast<double>(layout.scenario().episode_steps);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      const auto& thought = thoughts_.of(moment.first + lane);
      auto& out = beliefs_[lane];
      const double distance = std::hypot(static_cast<double>(thought.belief[0]) - x[lane],
                                         static_cast<double>(thought.belief[1]) - y[lane]);
      const double unit = std::max(std::hypot(x[lane], y[lane]), belief_floor);
      for (std::size_t r = 0; r < belief_radii.size(); ++r)
        out.right[r] += distance < belief_radii[r] * unit ? share : 0;
      for (std::size_t r = 0; r < absolute_radii.size(); ++r) out.within[r] += distance < absolute_radii[r] ? share : 0;
      out.distance += distance * share;
      out.change += thought.change * share;
    }
  }

  void stepped(const Layout& layout, const Block& block, const Moment& moment) override {
    scorer_->stepped(layout, block, moment);
  }

private:
  Thoughts& thoughts_;
  std::unique_ptr<Watcher> scorer_;
  EpisodeBeliefs* beliefs_;
};

}  // namespace

TransformerScores score_transformer(const Layout& layout, const std::shared_ptr<const TransformerMind>& mind,
                                    const Controller& prey, const EpisodePlan& plan, TransformerPlay play,
                                    const Progress& progress) {
  Thoughts thoughts{plan.first, std::vector<ThoughtRecord>(plan.episodes)};
  play.prey = prey;
  play.witness = [&](const ThoughtRecord& thought) { thoughts.of(thought.episode) = thought; };
  const auto predators = transformer_controller("transformer", mind, layout.scenario(), std::move(play));
  TransformerScores scores{std::vector<EpisodeScore>(plan.episodes), std::vector<EpisodeBeliefs>(plan.episodes)};
  play_episodes(
      layout, {predators, prey}, plan,
      [&](std::size_t begin) {
        return std::make_unique<BeliefWatcher>(thoughts, scores.play.data() + begin, scores.beliefs.data() + begin);
      },
      progress);
  return scores;
}

BeliefSummary summarise(std::span<const EpisodeBeliefs> beliefs) {
  const auto over = [&](auto&& part) {
    std::vector<double> values;
    for (const auto& episode : beliefs) values.push_back(part(episode));
    return estimate(values);
  };
  BeliefSummary summary;
  for (std::size_t r = 0; r < belief_radii.size(); ++r)
    summary.right[r] = over([&](const EpisodeBeliefs& episode) { return episode.right[r]; });
  for (std::size_t r = 0; r < absolute_radii.size(); ++r)
    summary.within[r] = over([&](const EpisodeBeliefs& episode) { return episode.within[r]; });
  summary.distance = over([](const EpisodeBeliefs& episode) { return episode.distance; });
  summary.change = over([](const EpisodeBeliefs& episode) { return episode.change; });
  return summary;
}

std::vector<TargetScore> score_targets(const Layout& layout, const std::shared_ptr<const TransformerMind>& mind,
                                       const Controller& prey, const EpisodePlan& plan, std::span<const double> targets,
                                       const Progress& progress) {
  std::vector<TargetScore> rows;
  for (const double target : targets) {
    TransformerPlay play;
    play.target = target;
    const auto scores =
        score_transformer(layout, mind, prey, plan, play, one_of(rows.size(), targets.size(), progress));
    TargetScore row{target, summarise(std::span<const EpisodeScore>(scores.play)).predators, std::nullopt};
    if (mind->believes()) row.beliefs = summarise(std::span<const EpisodeBeliefs>(scores.beliefs));
    rows.push_back(std::move(row));
  }
  return rows;
}

double best_target(std::span<const TargetScore> scores) {
  if (scores.empty()) throw UsageError("there is no return to ask for: give at least one");
  return std::max_element(
             scores.begin(), scores.end(),
             [](const TargetScore& a, const TargetScore& b) { return a.predators.mean < b.predators.mean; })
      ->target;
}

std::vector<ForcingScore> force_beliefs(const Layout& layout, const std::shared_ptr<const TransformerMind>& mind,
                                        const Controller& prey, const EpisodePlan& plan, const TransformerPlay& play,
                                        const Progress& progress) {
  if (plan.episodes % block_lanes == 1)
    throw UsageError(
        fmt::format("{} episodes: the last one would have no other beside it whose truth could be believed; give one "
                    "more",
                    plan.episodes));
  std::vector<ForcingScore> rows;
  std::vector<EpisodeScore> free;
  for (const auto forcing : belief_forcings) {
    TransformerPlay forced = play;
    forced.forcing = forcing;
    const auto scores =
        score_transformer(layout, mind, prey, plan, forced, one_of(rows.size(), belief_forcings.size(), progress));
    if (forcing == BeliefForcing::none) free = scores.play;
    std::vector<double> differences;
    for (std::size_t e = 0; e < free.size(); ++e) differences.push_back(scores.play[e].predators - free[e].predators);
    rows.push_back({forcing, summarise(std::span<const EpisodeScore>(scores.play)).predators, estimate(differences),
                    summarise(std::span<const EpisodeBeliefs>(scores.beliefs)).change});
  }
  return rows;
}

}  // namespace folk::mpe
