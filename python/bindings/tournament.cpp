// Tournaments: what ipd-tournament plays and writes, with its matrices as numpy arrays.

#include <folk/python/bindings/array.h>
#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>
#include <folk/python/bindings/text.h>

#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/roster_option.h>
#include <folk/tools/ipd_tournament/output.h>
#include <folk/tools/ipd_tournament/pictures.h>
#include <folk/tools/ipd_tournament/settings.h>

#include <folk/analysis/tournament/tournament.h>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace folk::python {
namespace {

/// What was played, and what the output says beside it.
struct HeldTournament {
  Tournament tournament;
  tools::TournamentLabels labels;
};

using TournamentPtr = std::shared_ptr<HeldTournament>;

/// A figure of each pair of behaviours, by behaviour, as the library keeps it.
py::array_t<double> table_of(const TournamentPtr& held, std::span<const double> figures) {
  const auto size = static_cast<py::ssize_t>(held->tournament.behaviours());
  return view_of(figures, {size, size}, held);
}

/// True where entrants are behaviours, so that a table of behaviours is one of entrants.
bool all_differ(const Tournament& tournament) { return tournament.behaviours() == tournament.size(); }

/// A figure of each pair of entrants; NaN where they did not meet.
template <class Figure>
py::array_t<double> matrix_of(const Tournament& tournament, Figure figure) {
  const std::size_t size = tournament.size();
  std::vector<double> cells(size * size, std::numeric_limits<double>::quiet_NaN());
  {
    const py::gil_scoped_release released;
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j)
        if (tournament.played(i, j)) cells[i * size + j] = figure(i, j);
  }
  const auto side = static_cast<py::ssize_t>(size);
  auto matrix = array_of(std::move(cells), {side, side});
  matrix.attr("flags").attr("writeable") = false;
  return matrix;
}

py::array_t<double> scores(const TournamentPtr& held) {
  const Tournament& tournament = held->tournament;
  if (all_differ(tournament) && tournament.settings().self_play && tournament.score_scale() == 1)
    return table_of(held, tournament.behaviour_scores());
  return matrix_of(tournament, [&](std::size_t i, std::size_t j) { return tournament.score(i, j); });
}

py::array_t<double> cooperations(const TournamentPtr& held) {
  const Tournament& tournament = held->tournament;
  if (all_differ(tournament) && tournament.settings().self_play)
    return table_of(held, tournament.behaviour_cooperations());
  return matrix_of(tournament, [&](std::size_t i, std::size_t j) { return tournament.cooperation(i, j); });
}

py::array_t<double> normalised(const TournamentPtr& held) {
  return matrix_of(held->tournament, [&](std::size_t i, std::size_t j) {
    return held->tournament.normalised(i, j).value_or(std::numeric_limits<double>::quiet_NaN());
  });
}

/// The columns of pairs.csv.
py::dict pairs(const TournamentPtr& held) {
  const Tournament& tournament = held->tournament;
  const double weight = tournament.settings().criterion.total_weight();
  std::vector<std::uint32_t> a;
  std::vector<std::uint32_t> b;
  std::array<std::vector<double>, 8> numbers;
  std::vector<std::string> figures;
  for (std::size_t i = 0; i < tournament.size(); ++i)
    for (std::size_t j = i; j < tournament.size(); ++j) {
      if (!tournament.played(i, j)) continue;
      a.push_back(static_cast<std::uint32_t>(i));
      b.push_back(static_cast<std::uint32_t>(j));
      const OutcomeWeights outcomes = tournament.outcomes(i, j);
      const std::array<double, 8> row{tournament.score(i, j),
                                      tournament.score(j, i),
                                      outcomes[0] / weight,
                                      outcomes[1] / weight,
                                      outcomes[2] / weight,
                                      outcomes[3] / weight,
                                      tournament.standard_error(i, j),
                                      tournament.standard_error(j, i)};
      for (std::size_t n = 0; n < row.size(); ++n) numbers[n].push_back(row[n]);
      figures.emplace_back(to_string(tournament.method(i, j)));
    }
  py::dict columns;
  columns["a"] = array_of(std::move(a));
  columns["b"] = array_of(std::move(b));
  constexpr std::array names{"score_a", "score_b", "CC", "CD", "DC", "DD", "standard_error_a", "standard_error_b"};
  for (std::size_t n = 0; n < names.size(); ++n) columns[names[n]] = array_of(std::move(numbers[n]));
  columns["figures"] = figures;
  return columns;
}

std::vector<std::string> strategies(const TournamentPtr& held) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < held->tournament.size(); ++i) names.push_back(held->tournament.name(i));
  return names;
}

std::vector<std::uint32_t> behaviours(const TournamentPtr& held) {
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < held->tournament.size(); ++i)
    found.push_back(static_cast<std::uint32_t>(held->tournament.behaviour(i)));
  return found;
}

/// What the program prints in this form: "text", "csv", "json" or, without matrices, "summary".
std::string tournament_form(const TournamentPtr& held, const std::string& form) {
  const Tournament& tournament = held->tournament;
  const tools::TournamentLabels& labels = held->labels;
  return written([&](std::ostream& out) {
    if (form == "text") tools::write_text(out, tournament, labels, {});
    if (form == "csv") tools::write_ranking_csv(out, tournament, {});
    if (form == "json") tools::write_json(out, tournament, labels, true, {});
    if (form == "summary") tools::write_json(out, tournament, labels, false, {});
  });
}

void draw_tournament(const TournamentPtr& held, const std::string& folder, const std::string& extension) {
  const py::gil_scoped_release released;
  tools::require_pictures(held->tournament.size(), false);
  tools::draw_pictures(folder, held->tournament, held->labels, nullptr, {extension, std::nullopt});
}

TournamentPtr played_tournament(const py::dict& options, const py::dict& guests, const py::object& progress) {
  const Call call(options, guests);
  const auto& values = call.values();
  const tools::ChosenGame game = tools::chosen_game(values);
  const TournamentSettings settings = tools::chosen_settings(values, call.common(), game.payoffs);
  tools::Field field = without_gil([&] { return tools::chosen_field(values, game.payoffs); });
  const std::string what = fmt::format("playing {} strategies", field.entrants.size());
  Tournament tournament = LongCall(what, progress).run([&](const Progress& told) {
    return play_tournament(std::move(field.entrants), field.core, settings, told);
  });
  return std::make_shared<HeldTournament>(HeldTournament{
      std::move(tournament),
      {tools::text_option(values, "strategies"), tools::text_option(values, "include"), game.title, {}}});
}

}  // namespace

void add_tournament(py::module_& module) {
  py::class_<HeldTournament, TournamentPtr>(module, "HeldTournament",
                                            "A tournament that was played; folk.Tournament shows it.")
      .def_property_readonly("strategies", strategies, "Names, in the order of rows and columns.")
      .def_property_readonly(
          "signature", [](const TournamentPtr& held) { return fmt::format("{:016x}", held->tournament.signature()); },
          "What the programs print as signature.")
      .def_property_readonly("behaviours", behaviours, "Which behaviour each entrant has.")
      .def_property_readonly(
          "behaviour_scores",
          [](const TournamentPtr& held) { return table_of(held, held->tournament.behaviour_scores()); },
          "A view: scores by behaviour, times score_scale.")
      .def_property_readonly(
          "behaviour_cooperations",
          [](const TournamentPtr& held) { return table_of(held, held->tournament.behaviour_cooperations()); },
          "A view: cooperations by behaviour.")
      .def_property_readonly(
          "score_scale", [](const TournamentPtr& held) { return held->tournament.score_scale(); },
          "The least common denominator of the payoffs.")
      .def("scores", scores, "Row against column.")
      .def("cooperations", cooperations, "Row against column.")
      .def("normalised", normalised, "Row against column.")
      .def("pairs", pairs, "The columns of pairs.csv.")
      .def("form", tournament_form, "What ipd-tournament prints: text, csv, json, summary.", py::arg("name"))
      .def("draw", draw_tournament, "The pictures of --plot, into a folder.", py::arg("folder"), py::arg("extension"));
  module.def("tournament", played_tournament, "Plays what the options of ipd-tournament describe.", py::arg("options"),
             py::arg("guests"), py::arg("progress"));
}

}  // namespace folk::python
