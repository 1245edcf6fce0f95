#include <folk/mpe/evaluation/episode_record.h>
#include <folk/mpe/evaluation/episodes.h>

#include <memory>

namespace folk::mpe {
namespace {

Point point(const double* rows) { return {rows[0], rows[block_lanes]}; }

/// Lane 0 of a block, as a row.
EpisodeRecord::Row row_of(const Layout& layout, const Block& block) {
  EpisodeRecord::Row row;
  for (std::size_t i = 0; i < layout.agents() + layout.landmarks(); ++i) {
    const double* state = block.state + layout.position_row(i) * block_lanes;
    row.state.positions.push_back(point(state));
    if (i >= layout.agents()) continue;
    row.state.velocities.push_back(point(state + 2 * block_lanes));
    row.actions.push_back(point(block.actions + 2 * i * block_lanes));
    row.rewards.push_back(block.rewards[i * block_lanes]);
    auto& observation = row.observations.emplace_back();
    for (std::size_t k = layout.observation_begin(i); k < layout.observation_begin(i + 1); ++k)
      observation.push_back(block.observations[k * block_lanes]);
  }
  return row;
}

class Recorder final : public Watcher {
public:
  explicit Recorder(EpisodeRecord& record)
      : record_(record) {}

  void acted(const Layout& layout, const Block& block, const Moment& moment) override {
    if (moment.step > 0) return;
    auto row = row_of(layout, block);
    row.actions.assign(layout.agents(), Point{});
    record_.rows.push_back(std::move(row));
  }

  void stepped(const Layout& layout, const Block& block, const Moment&) override {
    record_.rows.push_back(row_of(layout, block));
  }

private:
  EpisodeRecord& record_;
};

}  // namespace

EpisodeRecord record_episode(const Layout& layout, const Cast& cast, std::uint64_t seed, std::uint64_t number) {
  return record_episode(layout, cast, EpisodePlan{seed, number, 1, 1});
}

EpisodeRecord record_episode(const Layout& layout, const Cast& cast, EpisodePlan plan) {
  EpisodeRecord record{layout.scenario(), {}, cast.predators.name, cast.prey.name, plan.seed, plan.first};
  plan.episodes = 1;
  play_episodes(layout, cast, plan, [&](std::size_t) { return std::make_unique<Recorder>(record); });
  return record;
}

}  // namespace folk::mpe
