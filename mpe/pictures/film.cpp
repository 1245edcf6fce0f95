#include <folk/analysis/pictures/caption.h>
#include <folk/games/error.h>
#include <folk/mpe/pictures/display_list.h>
#include <folk/mpe/pictures/film.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk::mpe {
namespace {

using Row = EpisodeRecord::Row;

void require_drawable_row(const Scenario& scenario, const Row& row, std::size_t step) {
  const auto refuse = [&](std::string_view why) {
    throw UsageError(fmt::format("an episode's picture: step {} {}", step, why));
  };
  if (row.state.positions.size() != scenario.entities.size() || row.rewards.size() != scenario.agents())
    refuse(fmt::format("does not fit the scenario '{}'", excerpt(scenario.name)));
  const auto finite = [](const Point& point) { return std::isfinite(point.x) && std::isfinite(point.y); };
  if (!std::all_of(row.state.positions.begin(), row.state.positions.end(), finite))
    refuse("has a position that is not finite");
}

/// Adds the contacts of a row to those of a frame.
void mark_contacts(const Scenario& scenario, const Row& row, std::vector<bool>& touching) {
  const std::size_t prey = scenario.prey();
  const Point& target = row.state.positions[prey];
  for (std::size_t i = 0; i < prey; ++i) {
    const Point& position = row.state.positions[i];
    const double distance = std::hypot(target.x - position.x, target.y - position.y);
    if (distance < scenario.entities[i].radius + scenario.entities[prey].radius) touching[i] = touching[prey] = true;
  }
}

std::string player_name(const std::string& name) {
  constexpr std::size_t longest_name = 24;
  return name.empty() ? "unknown" : printable(name, longest_name);
}

std::string title_of(const EpisodeRecord& record) {
  const std::string scenario = printable(record.scenario.name, 24);
  if (record.predators.empty() && record.prey.empty()) return scenario + ": a recorded episode";
  return fmt::format("{}: {} against {}", scenario, player_name(record.predators), player_name(record.prey));
}

std::string subtitle_of(const EpisodeRecord& record, const Frame& last) {
  const bool seed_known = !record.predators.empty() || !record.prey.empty();
  return fmt::format("episode {}{} · a predator's return after {} steps: {}", record.number,
                     seed_known ? fmt::format(" of seed {}", record.seed) : "", last.step,
                     return_text(last.predators_return));
}

}  // namespace

std::vector<std::size_t> equally_spaced(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t wanted = std::min(count, std::max<std::size_t>(most, 2));
  if (wanted == 1) return {0};
  for (std::size_t i = 0; i < wanted; ++i)
    chosen.push_back((2 * i * (count - 1) + wanted - 1) / (2 * (wanted - 1)));  // rounded
  return chosen;
}

Film film_of(const EpisodeRecord& record, std::size_t most) {
  require_sound(record.scenario);
  if (record.rows.empty()) throw UsageError("an episode's picture: there is no step in it");
  Film film{record.scenario, title_of(record), {}, {}, {}};
  const auto shown = equally_spaced(record.rows.size(), most);
  Frame frame;
  frame.touching.assign(record.scenario.agents(), false);
  for (std::size_t step = 0; step < record.rows.size(); ++step) {
    const Row& row = record.rows[step];
    require_drawable_row(record.scenario, row, step);
    frame.predators_return += row.rewards[0];
    if (!std::isfinite(frame.predators_return))
      throw UsageError(fmt::format("an episode's picture: step {} has a return that is not finite", step));
    if (step > 0) mark_contacts(record.scenario, row, frame.touching);  // an overlap at the reset earns nothing
    if (step != shown[film.frames.size()]) continue;
    frame.step = step;
    frame.positions = row.state.positions;
    film.frames.push_back(frame);
    frame.touching.assign(record.scenario.agents(), false);
  }
  film.subtitle = subtitle_of(record, film.frames.back());
  film.caption = caption_text({printable(record.scenario.name, 24), fmt::format("{} steps", film.steps())});
  return film;
}

std::string return_text(double value) {
  if (std::abs(value) >= 1e6) return fmt::format("{:.2e}", value);
  return fmt::format("{:.1f}", std::round(10 * value) / 10 + 0.0);
}

}  // namespace folk::mpe
