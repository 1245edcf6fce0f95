#include <folk/tools/sce_check/pictures.h>

#include <fmt/format.h>
#include <folk/analysis/pictures/automaton_picture.h>
#include <folk/analysis/pictures/belief_plots.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/analysis/pictures/render.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

/// Machines with more states are not minimised.
constexpr std::size_t most_searched = 10'000;

std::string base64(const std::string& bytes) {
  using namespace boost::archive::iterators;
  using Letters = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  std::string text(Letters(bytes.begin()), Letters(bytes.end()));
  text.append((3 - bytes.size() % 3) % 3, '=');
  return text;
}

Html remark(const std::string& words) { return element_of("p", "missing", words) + "\n"; }

}  // namespace

Pictures::Pictures(Caption caption)
    : caption_(std::move(caption)) {
  std::error_code error;
  const fs::path base = fs::temp_directory_path(error);
  if (error) throw EnvironmentError(fmt::format("no folder for temporary files: {}; set TMPDIR", error.message()));
  std::string name = (base / "sce-check-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw EnvironmentError(fmt::format("{}: no temporary folder can be made there: {}", base.string(),
                                       std::generic_category().message(errno)));
  folder_ = name;
}

Pictures::~Pictures() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Html Pictures::picture(const std::string& css_class, const std::string& words,
                       const std::function<void(const fs::path&)>& draw) const {
  const fs::path path = folder_ / "picture.svg";
  try {
    draw(path);
  } catch (const RendererMissing& missing) {
    return remark(fmt::format("{}: no picture, {}", words, missing.what()));
  }
  // An image of its own: the names inside one picture mean nothing in another, and nothing in it can run.
  const Html image = Html::markup(fmt::format("<img src=\"data:image/svg+xml;base64,{}\" alt=\"{}\">",
                                              base64(read_text_file(path)), Html(words).string()));
  return element_of("figure", css_class, image) + "\n";
}

Html Pictures::beliefs(const OpponentReport& report, const std::string& policy) const {
  if (!report.record || !report.belief || report.record->matches.empty()) return {};
  const auto& matches = report.record->matches;
  // Names may be whole command lines: the section's heading has room for them, a picture has not.
  BeliefPathPlot plot{matches.front(), "Belief and the moves that were played", caption_};
  if (matches.size() > 1) plot.title += fmt::format(", match 1 of {}", matches.size());
  if (plot.match.size() > most_drawn_rounds) plot.title += fmt::format(", first {} rounds", most_drawn_rounds);
  return picture("wide", fmt::format("{}: {} about {}", plot.title, policy, report.opponent),
                 [&](const fs::path& path) { draw(plot, path); });
}

Html Pictures::accuracy(const SceReport& report) const {
  if (!report.belief) return {};
  AccuracyPlot plot{{}, {}, "Accuracy of beliefs by opponent", caption_};
  for (const auto& opponent : report.opponents) {
    plot.names.push_back(opponent.opponent);
    plot.shares.push_back(opponent.belief ? opponent.belief->accuracy() : std::nullopt);
  }
  if (plot.names.size() > most_plotted)
    return remark(fmt::format("{}: no picture, more than {} opponents", plot.title, most_plotted));
  return picture("plot", plot.title, [&](const fs::path& path) { draw(plot, path); });
}

Html Pictures::calibration(const SceReport& report) const {
  if (!report.belief) return {};
  const CalibrationPlot plot{report.belief->bins, "Calibration of beliefs", caption_};
  return picture("plot", plot.title + ": how often C was played when it was believed in so much",
                 [&](const fs::path& path) { draw(plot, path); });
}

Html Pictures::machine(const std::string& name, const Machine& machine) const {
  // Deviations count, so that states differ that only own moves of others than the machine's tell apart.
  constexpr Sense sense = Sense::any_own_moves;
  const auto table = machine.finite() ? tabulate(machine, sense, most_searched) : std::nullopt;
  if (!table)
    return remark(fmt::format("{} has {} states: too many to draw", name,
                              machine.finite() ? fmt::format("over {}", most_searched) : "infinitely many"));
  const Automaton smallest = minimise(*table, sense);
  return automaton(name, smallest, sense, names_behind(smallest, machine, sense));
}

Html Pictures::automaton(const std::string& name, const Automaton& automaton, Sense sense,
                         std::vector<std::vector<std::string>> state_names) const {
  if (automaton.size() > most_drawn_states)
    return remark(fmt::format("{} has {} states: too many to draw", name, automaton.size()));
  // A large one would be too small to read at the width of the page: it scrolls.
  const std::string css_class = automaton.size() > 20 ? "automaton large" : "automaton";
  return picture(
      css_class,
      fmt::format("{} as an automaton of {} state{}", name, automaton.size(), automaton.size() == 1 ? "" : "s"),
      [&](const fs::path& path) {
        draw_automaton(automaton, {name, sense, 0, state_names, {}}, path, PictureFormat::svg);
      });
}

}  // namespace folk::tools
