#include <folk/games/error.h>
#include <folk/mpe/evaluation/recording_columns.h>

#include <fmt/format.h>

#include <algorithm>

namespace folk::mpe {
namespace {

void require_row_of(const Scenario& scenario, const EpisodeRecord::Row& row) {
  const std::size_t agents = scenario.agents();
  bool fits = row.state.positions.size() == scenario.entities.size() && row.state.velocities.size() == agents &&
              row.actions.size() == agents && row.observations.size() == agents && row.rewards.size() == agents;
  for (std::size_t i = 0; fits && i < agents; ++i) fits = row.observations[i].size() == scenario.observation_size(i);
  if (!fits) throw UsageError(fmt::format("a row of an episode that is not one of {}", scenario.name));
}

/// Takes numbers off the front of a row.
class Taker {
public:
  explicit Taker(std::span<const double> numbers)
      : numbers_(numbers) {}

  double number() {
    const double first = numbers_.front();
    numbers_ = numbers_.subspan(1);
    return first;
  }
  Point point() {
    const double x = number();
    return {x, number()};
  }

private:
  std::span<const double> numbers_;
};

}  // namespace

std::vector<RecordingColumn> recording_columns(const Scenario& scenario) {
  std::vector<RecordingColumn> columns;
  for (std::size_t i = 0; i < scenario.entities.size(); ++i)
    for (const char* part : {"px", "py", "vx", "vy"})
      columns.push_back({fmt::format("{}.{}", scenario.entities[i].name, part), Quantity::state});
  for (std::size_t i = 0; i < scenario.agents(); ++i)
    for (const char axis : {'x', 'y'}) columns.push_back({fmt::format("act{}.{}", i, axis), Quantity::action});
  for (std::size_t i = 0; i < scenario.agents(); ++i)
    for (std::size_t k = 0; k < scenario.observation_size(i); ++k)
      columns.push_back({fmt::format("obs{}.{}", i, k), Quantity::observation});
  for (std::size_t i = 0; i < scenario.agents(); ++i) columns.push_back({fmt::format("rew{}", i), Quantity::reward});
  return columns;
}

std::vector<double> to_numbers(const Scenario& scenario, const EpisodeRecord::Row& row) {
  require_row_of(scenario, row);
  std::vector<double> numbers;
  const auto put = [&](const Point& point) { numbers.insert(numbers.end(), {point.x, point.y}); };
  for (std::size_t i = 0; i < scenario.entities.size(); ++i) {
    put(row.state.positions[i]);
    put(i < scenario.agents() ? row.state.velocities[i] : Point{});
  }
  for (const Point& action : row.actions) put(action);
  for (const auto& observation : row.observations)
    numbers.insert(numbers.end(), observation.begin(), observation.end());
  numbers.insert(numbers.end(), row.rewards.begin(), row.rewards.end());
  return numbers;
}

EpisodeRecord::Row row_of_numbers(const Scenario& scenario, std::span<const double> numbers) {
  EpisodeRecord::Row row;
  Taker taker(numbers);
  for (std::size_t i = 0; i < scenario.entities.size(); ++i) {
    row.state.positions.push_back(taker.point());
    const Point velocity = taker.point();
    if (i < scenario.agents()) row.state.velocities.push_back(velocity);
  }
  for (std::size_t i = 0; i < scenario.agents(); ++i) row.actions.push_back(taker.point());
  for (std::size_t i = 0; i < scenario.agents(); ++i) {
    auto& observation = row.observations.emplace_back();
    for (std::size_t k = 0; k < scenario.observation_size(i); ++k) observation.push_back(taker.number());
  }
  for (std::size_t i = 0; i < scenario.agents(); ++i) row.rewards.push_back(taker.number());
  return row;
}

}  // namespace folk::mpe
