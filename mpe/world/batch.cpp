#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>
#include <folk/mpe/world/batch.h>
#include <folk/mpe/world/random_stream.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace folk::mpe {
namespace {

/// Blocks that a thread takes at a time where there are many: starting threads must not count.
constexpr std::size_t blocks_together = 64;

/// From here on a batch does not fit the caches: its observations go past them.
constexpr std::size_t large_batch_bytes = std::size_t{64} << 20U;

constexpr double agent_range = 1.0;
constexpr double landmark_range = 0.9;

template <class Random>
Point uniform_point(Random& random, double range) {
  const double x = -range + 2 * range * random.uniform();
  const double y = -range + 2 * range * random.uniform();
  return {x, y};
}

bool fits(double x) { return std::abs(x) <= largest_action; }
bool fits(const Point& point) { return fits(point.x) && fits(point.y); }

}  // namespace

Batch::Batch(const Scenario& scenario, std::size_t episodes, unsigned threads)
    : layout_(scenario),
      episodes_(episodes),
      blocks_((episodes + block_lanes - 1) / block_lanes),
      threads_(std::max(1U, threads)) {
  if (episodes == 0) throw UsageError("a batch without episodes: ask for at least one");
  const auto rows = [&](std::size_t count) { return AlignedDoubles(blocks_ * count * block_lanes, 0.0); };
  state_ = rows(layout_.state_rows());
  actions_ = rows(layout_.action_rows());
  observations_ = rows(layout_.observation_rows());
  rewards_ = rows(layout_.reward_rows());
}

Block Batch::block(std::size_t b) {
  const auto at = [&](AlignedDoubles& array, std::size_t rows) { return array.data() + b * rows * block_lanes; };
  return {at(state_, layout_.state_rows()), at(actions_, layout_.action_rows()),
          at(observations_, layout_.observation_rows()), at(rewards_, layout_.reward_rows()),
          std::min(block_lanes, episodes_ - b * block_lanes)};
}

Batch::Place Batch::place(std::size_t episode) const {
  if (episode >= episodes_) throw UsageError(fmt::format("episode {} of a batch of {}", episode, episodes_));
  return {const_cast<Batch*>(this)->block(episode / block_lanes), episode % block_lanes};
}

void Batch::reset(std::uint64_t seed, std::uint64_t first) {
  parallel_for(blocks_, blocks_ < blocks_together ? 1 : threads_, [&](std::size_t b, unsigned) {
    for (std::size_t e = b * block_lanes; e < std::min(episodes_, (b + 1) * block_lanes); ++e)
      place_at_random(e, seed, first + e);
    observe(layout_, block(b));
  });
}

void Batch::reset_episode(std::size_t episode, std::uint64_t seed, std::uint64_t number) {
  place_at_random(episode, seed, number);
  observe_episode(episode);
}

void Batch::place_at_random(std::size_t episode, std::uint64_t seed, std::uint64_t number) {
  RandomStream random = random_stream(seed, RandomUse::reset, number);
  std::array<Point, most_entities> positions;
  const std::size_t entities = layout_.agents() + layout_.landmarks();
  for (std::size_t i = 0; i < entities; ++i)
    positions[i] = uniform_point(random, i < layout_.agents() ? agent_range : landmark_range);
  set_positions(episode, std::span(positions).first(entities));
}

void Batch::reset_episode(std::size_t episode, NumpyRandom& random) {
  std::vector<Point> positions;
  for (std::size_t i = 0; i < scenario().entities.size(); ++i)
    positions.push_back(uniform_point(random, i < layout_.agents() ? agent_range : landmark_range));
  // The published program draws food and forests a second time.
  for (const auto* again : {&layout_.food(), &layout_.forests()})
    for (const std::size_t i : *again) positions[i] = uniform_point(random, landmark_range);
  set_positions(episode, positions);
  observe_episode(episode);
}

void Batch::set_positions(std::size_t episode, std::span<const Point> positions) {
  const auto [block, lane] = place(episode);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    double* row = block.state + layout_.position_row(i) * block_lanes + lane;
    row[0] = positions[i].x;
    row[block_lanes] = positions[i].y;
    if (i < layout_.agents()) row[2 * block_lanes] = row[3 * block_lanes] = 0;
  }
}

/// Observations of the register that an episode stands in; those of its neighbours come out as they are.
void Batch::observe_episode(std::size_t episode) {
  const Place here = place(episode);
  const Block& block = here.block;
  const std::size_t first = here.lane / vector_lanes * vector_lanes;
  std::array<double, vector_lanes * most_entities> rewards;
  const auto each_reward = [&](auto with) {
    for (std::size_t row = 0; row < layout_.reward_rows(); ++row)
      for (std::size_t k = 0; k < vector_lanes; ++k)
        with(block.rewards[row * block_lanes + first + k], rewards[row * vector_lanes + k], first + k == here.lane);
  };
  each_reward([](double& now, double& kept, bool) { kept = now; });
  observe(layout_, {block.state + first, block.actions + first, block.observations + first, block.rewards + first,
                    vector_lanes});
  each_reward([](double& now, double& kept, bool anew) { now = anew ? 0 : kept; });
}

void Batch::set_action(std::size_t episode, std::size_t agent, Point action) {
  const auto [block, lane] = place(episode);
  if (agent >= layout_.agents()) throw UsageError(fmt::format("agent {} of {}", agent, layout_.agents()));
  if (!fits(action))
    throw UsageError(fmt::format("action ({}, {}) of agent {} in episode {}: expected finite numbers up to {}",
                                 action.x, action.y, agent, episode, largest_action));
  block.actions[2 * agent * block_lanes + lane] = action.x;
  block.actions[(2 * agent + 1) * block_lanes + lane] = action.y;
}

void Batch::step() {
  const std::size_t pieces = (blocks_ + blocks_together - 1) / blocks_together;
  const auto each_block = [&](auto work) {
    parallel_for(pieces, threads_, [&](std::size_t piece, unsigned) {
      for (std::size_t b = piece * blocks_together; b < std::min(blocks_, (piece + 1) * blocks_together); ++b) work(b);
    });
  };
  each_block([&](std::size_t b) {
    if (const auto bad = find_bad_action(layout_, block(b)))
      throw UsageError(fmt::format("action of agent {} in episode {}: expected finite numbers", bad->agent,
                                   b * block_lanes + bad->lane));
  });
  const std::size_t bytes = blocks_ * block_lanes * sizeof(double) * layout_.observation_rows();
  const Stores stores = bytes >= large_batch_bytes ? Stores::past_caches : Stores::cached;
  each_block([&](std::size_t b) { mpe::step(layout_, block(b), stores); });
}

std::vector<double> Batch::observation(std::size_t episode, std::size_t agent) const {
  const auto [block, lane] = place(episode);
  if (agent >= layout_.agents()) throw UsageError(fmt::format("agent {} of {}", agent, layout_.agents()));
  std::vector<double> numbers;
  for (std::size_t row = layout_.observation_begin(agent); row < layout_.observation_begin(agent + 1); ++row)
    numbers.push_back(block.observations[row * block_lanes + lane]);
  return numbers;
}

double Batch::reward(std::size_t episode, std::size_t agent) const {
  const auto [block, lane] = place(episode);
  if (agent >= layout_.agents()) throw UsageError(fmt::format("agent {} of {}", agent, layout_.agents()));
  return block.rewards[agent * block_lanes + lane];
}

EpisodeState Batch::state(std::size_t episode) const {
  const auto [block, lane] = place(episode);
  EpisodeState state;
  for (std::size_t i = 0; i < scenario().entities.size(); ++i) {
    const double* row = block.state + layout_.position_row(i) * block_lanes + lane;
    state.positions.push_back({row[0], row[block_lanes]});
    if (i < layout_.agents()) state.velocities.push_back({row[2 * block_lanes], row[3 * block_lanes]});
  }
  return state;
}

void Batch::set_state(std::size_t episode, const EpisodeState& state) {
  const auto [block, lane] = place(episode);
  if (state.positions.size() != scenario().entities.size() || state.velocities.size() != layout_.agents())
    throw UsageError(fmt::format("a state of {} entities, {} of them moving: {} has {} and {}", state.positions.size(),
                                 state.velocities.size(), scenario().name, scenario().entities.size(),
                                 layout_.agents()));
  for (const auto* points : {&state.positions, &state.velocities})
    for (const Point& point : *points)
      if (!fits(point))
        throw UsageError(fmt::format("a state with a number that is not finite or beyond {}", largest_action));
  set_positions(episode, state.positions);
  for (std::size_t i = 0; i < layout_.agents(); ++i) {
    double* row = block.state + layout_.position_row(i) * block_lanes + lane;
    row[2 * block_lanes] = state.velocities[i].x;
    row[3 * block_lanes] = state.velocities[i].y;
  }
  observe_episode(episode);
}

}  // namespace folk::mpe
