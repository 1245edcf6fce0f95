#include <folk/mpe/pictures/animation_clock.h>
#include <folk/mpe/pictures/captions.h>
#include <folk/mpe/pictures/counters.h>
#include <folk/mpe/pictures/episode_animation.h>
#include <folk/mpe/pictures/svg_shapes.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace folk::mpe {
namespace {

constexpr std::size_t most_frames = 121;
constexpr double arena_side = 520;
constexpr double side_width = 176;  // counters and legend, to the right of the arena
constexpr double side_gap = 22;

bool in_any_frame(const Film& film, const std::function<bool(std::size_t)>& is) {
  for (std::size_t i = 0; i < film.frames.size(); ++i)
    if (is(i)) return true;
  return false;
}

/// The end of an agent's trail, brighter towards the agent: three dashes of one path, each shorter than the one before,
/// that run along it.
std::string bright_trail(const Film& film, const ArenaView& view, const AnimationClock& clock, std::size_t agent) {
  const auto places = trail(film, view, agent, clock.last());
  std::vector<double> run{0};
  for (std::size_t i = 1; i < places.size(); ++i)
    run.push_back(run.back() + std::hypot(places[i].x - places[i - 1].x, places[i].y - places[i - 1].y));
  std::string text =
      fmt::format("<g class=\"trail\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\" stroke-opacity=\"0.4\">\n",
                  colour_of(film.scenario, agent));
  for (const double units : std::array{0.75, 0.5, 0.25}) {
    const double dash = units * view.scale();
    const double blank = dash + run.back() + 9;  // so long that the pattern does not come twice
    const auto offset = [&](std::size_t frame) { return dash - run[frame]; };
    text += fmt::format("<path d=\"{}\" stroke-dasharray=\"{} {}\" stroke-dashoffset=\"{}\">{}</path>\n",
                        svg_path_data(places), svg_number(dash), svg_number(blank), svg_number(offset(clock.last())),
                        clock.glide("stroke-dashoffset", offset));
  }
  return text + "</g>\n";
}

/// The ring around an agent while it is in contact; it flashes once a frame.
std::string flashing_ring(const Film& film, const ArenaView& view, const AnimationClock& clock, std::size_t agent) {
  const auto touching = [&](std::size_t frame) -> bool { return film.frames[frame].touching[agent]; };
  if (!in_any_frame(film, touching)) return {};
  return fmt::format(
      "<g class=\"contact\" visibility=\"{}\">{}<animate attributeName=\"opacity\" dur=\"{}s\" "
      "repeatCount=\"indefinite\" values=\"1;1;0.35\"/>\n{}</g>\n",
      touching(clock.last()) ? "visible" : "hidden", clock.jump("visibility", touching, "visible", "hidden"),
      AnimationClock::frame_seconds, svg_elements(draw_contact(film, view, agent, {})));
}

std::string moving_agent(const Film& film, const ArenaView& view, const AnimationClock& clock, std::size_t agent) {
  const double radius = film.scenario.entities[agent].radius;
  const auto position = [&](std::size_t frame) { return film.frames[frame].positions[agent]; };
  const auto place = [&](std::size_t frame) { return view.place(position(frame), radius); };
  const auto beyond = [&](std::size_t frame) { return view.beyond(position(frame), radius); };
  std::string disc = svg_elements(draw_agent(film, view, agent, {}));
  if (in_any_frame(film, beyond))
    disc = fmt::format("<g opacity=\"{}\">{}\n{}</g>\n", beyond(clock.last()) ? beyond_opacity : 1.0,
                       clock.jump("opacity", beyond, fmt::format("{}", beyond_opacity), "1"), disc);
  return fmt::format("<g class=\"agent\">{}</g>\n", clock.moved(place, AnimationClock::Travel::glides,
                                                                disc + flashing_ring(film, view, clock, agent)));
}

}  // namespace

std::string animated_svg(const EpisodeRecord& record) {
  const Film film = film_of(record, most_frames);
  const AnimationClock clock(film.frames.size());
  const ArenaView view = ArenaView(film, arena_side, arena_side).moved_to({margin, heading_height});
  const Point side{margin + view.width() + side_gap, heading_height};
  const double side_height = counters_height + legend_height(film, view, side_width);
  const double width = std::max({side.x + side_width + margin, heading_width(film), caption_width(film)});
  const double height = heading_height + std::max(view.height(), side_height) + 8 + caption_height;

  Path paper = rectangle({0, 0}, width, height);
  paper.fill = Paint{"#ffffff"};
  std::string body = svg_elements({paper}) + svg_elements(draw_heading(film)) + svg_elements(draw_ground(film, view)) +
                     svg_elements(draw_trails(film, view, clock.last()));
  for (std::size_t agent = 0; agent < film.scenario.agents(); ++agent) body += bright_trail(film, view, clock, agent);
  body += svg_elements(draw_touches(film, view, clock.last()));
  for (std::size_t agent = 0; agent < film.scenario.agents(); ++agent) body += moving_agent(film, view, clock, agent);
  body += animated_counters(film, clock, side, side_width);
  body += svg_elements(draw_legend(film, view, {side.x, side.y + counters_height}, side_width));
  body += svg_elements(draw_caption(film, height));
  return svg_document(width, height, film.title, body);
}

}  // namespace folk::mpe
