#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>
#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/world/batch.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk::mpe {
namespace {

/// A thread's own: a block's arrays and a player for each agent.
class Table {
public:
  Table(const Layout& layout, const Cast& cast)
      : layout_(layout),
        cast_(cast),
        batch_(layout.scenario(), cast.one_by_one() ? 1 : block_lanes),
        players_(cast.players(layout)) {}

  /// Plays `lanes` episodes from `first` on.
  void play(const EpisodePlan& plan, std::uint64_t first, std::size_t lanes, Watcher& watcher) {
    batch_.reset(plan.seed, first);
    for (std::size_t lane = 0; plan.place && lane < lanes; ++lane) plan.place(batch_, lane, first + lane);
    Block block = batch_.block(0);
    block.lanes = lanes;
    Moment moment{plan.seed, first, 0};
    for (std::size_t agent = 0; agent < players_.size(); ++agent) players_[agent]->start(layout_, block, agent, moment);
    while (moment.step < layout_.scenario().episode_steps) {
      for (std::size_t agent = 0; agent < players_.size(); ++agent) players_[agent]->act(layout_, block, agent, moment);
      if (const auto bad = find_bad_action(layout_, block))
        throw UsageError(fmt::format("{}: an action that is not finite, of agent {} in episode {}",
                                     cast_.of(layout_, bad->agent).name, bad->agent, first + bad->lane));
      watcher.acted(layout_, block, moment);
      step(layout_, block);
      ++moment.step;
      watcher.stepped(layout_, block, moment);
    }
  }

  /// No more episodes follow.
  void finish() {
    for (const auto& player : players_) player->finish();
  }

private:
  const Layout& layout_;
  const Cast& cast_;
  Batch batch_;
  Team players_;
};

class Scorer final : public Watcher {
public:
  explicit Scorer(EpisodeScore* scores)
      : scores_(scores) {}

  void stepped(const Layout& layout, const Block& block, const Moment&) override {
    const auto& scenario = layout.scenario();
    const std::size_t prey = scenario.prey();
    const double steps = static_cast<double>(scenario.episode_steps);
    const double* prey_position = block.state + layout.position_row(prey) * block_lanes;
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      EpisodeScore& score = scores_[lane];
      score.predators += block.rewards[lane];
      score.prey += block.rewards[prey * block_lanes + lane];
      const double x = prey_position[lane];
      const double y = prey_position[block_lanes + lane];
      double nearest = 0;
      double contacts = 0;
      for (std::size_t i = 0; i < prey; ++i) {
        const double* position = block.state + layout.position_row(i) * block_lanes;
        const double dx = x - position[lane];
        const double dy = y - position[block_lanes + lane];
        const double distance = std::sqrt(dx * dx + dy * dy);
        score.distance += distance / (steps * static_cast<double>(prey));
        nearest = i == 0 ? distance : std::min(nearest, distance);
        if (distance < scenario.entities[i].radius + scenario.entities[prey].radius) ++contacts;
      }
      score.nearest += nearest / steps;
      score.contacts += contacts;
      if (contacts > 0) ++score.caught_steps;
      if (std::abs(x) > 1 || std::abs(y) > 1) ++score.outside_steps;
    }
  }

private:
  EpisodeScore* scores_;
};

}  // namespace

void play_episodes(const Layout& layout, const Cast& cast, const EpisodePlan& plan,
                   const std::function<std::unique_ptr<Watcher>(std::size_t)>& watcher, const Progress& progress) {
  const std::size_t together = cast.one_by_one() ? 1 : block_lanes;
  const unsigned threads = cast.one_by_one() ? 1 : std::max(1U, plan.threads);
  std::vector<std::unique_ptr<Table>> tables(threads);
  parallel_for((plan.episodes + together - 1) / together, threads,
               [&](std::size_t piece, unsigned worker) {
                 if (!tables[worker]) tables[worker] = std::make_unique<Table>(layout, cast);
                 const std::size_t begin = piece * together;
                 const auto looks_on = watcher(begin);
                 tables[worker]->play(plan, plan.first + begin, std::min(together, plan.episodes - begin), *looks_on);
               },
               progress);
  for (const auto& table : tables)
    if (table) table->finish();
}

std::unique_ptr<Watcher> scoring(EpisodeScore* scores) { return std::make_unique<Scorer>(scores); }

std::vector<EpisodeScore> score_episodes(const Layout& layout, const Cast& cast, const EpisodePlan& plan,
                                         const Progress& progress) {
  std::vector<EpisodeScore> scores(plan.episodes);
  play_episodes(
      layout, cast, plan, [&](std::size_t begin) { return scoring(scores.data() + begin); }, progress);
  return scores;
}

}  // namespace folk::mpe
