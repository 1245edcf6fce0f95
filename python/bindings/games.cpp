// Stage games.

#include <folk/python/bindings/parts.h>

#include <folk/games/payoffs.h>
#include <folk/games/stage_game.h>
#include <folk/games/stage_games/nfg.h>

#include <pybind11/stl.h>

#include <array>
#include <string>
#include <vector>

namespace folk::python {
namespace {

using Texts = std::vector<std::vector<std::string>>;

/// Of payoffs as texts, a row an action of the row player; both tables have the same shape.
StageGame game_of(const Texts& rows, const Texts& columns, std::string title, std::array<std::string, 2> players,
                  std::array<std::vector<std::string>, 2> actions) {
  std::vector<std::array<Rational, 2>> payoffs;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      payoffs.push_back({parse_rational(rows[i][j]), parse_rational(columns[i][j])});
  return StageGame(std::move(title), std::move(players), std::move(actions), std::move(payoffs));
}

/// The payoffs of a seat exactly, as texts.
Texts payoffs_of(const StageGame& game, bool second) {
  Texts texts(game.rows());
  for (std::size_t i = 0; i < game.rows(); ++i)
    for (std::size_t j = 0; j < game.columns(); ++j)
      texts[i].push_back(to_text(game.payoff(second ? Seat::second : Seat::first, i, j)));
  return texts;
}

}  // namespace

void add_games(py::module_& module) {
  py::class_<StageGame>(module, "StageGame", "A two-player game in strategic form, its payoffs exact.")
      .def(py::init(&game_of), py::arg("rows"), py::arg("columns"), py::arg("title"), py::arg("players"),
           py::arg("actions"))
      .def_property_readonly("title", &StageGame::title, "As its author wrote it.")
      .def_property_readonly("comment", &StageGame::comment, "What its author says of it.")
      .def_property_readonly("players", &StageGame::players, "Names of the row and the column player.")
      .def_property_readonly(
          "actions",
          [](const StageGame& game) {
            return std::array{game.actions(Seat::first), game.actions(Seat::second)};
          },
          "Names of their actions.")
      .def_property_readonly("is_symmetric", &StageGame::is_symmetric, "True where both seats are alike.")
      .def("payoffs", payoffs_of, "Exact payoffs of a seat, as texts.", py::arg("second"))
      .def(
          "nfg", [](const StageGame& game) { return write_nfg(game, NfgForm::outcome); },
          "The game as Gambit writes it.")
      .def(
          "__eq__", [](const StageGame& a, const StageGame& b) { return a.same_game(b); }, py::is_operator())
      .def("__repr__", [](const StageGame& game) {
        return "<folk.StageGame " + game.title() + ", " + std::to_string(game.rows()) + " x " +
               std::to_string(game.columns()) + " actions>";
      });
  module.def(
      "read_game", [](const std::string& file) { return read_nfg_file(file); }, "The game of a .nfg file.",
      py::arg("file"));
}

}  // namespace folk::python
