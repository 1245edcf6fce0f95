// Players that are written in Python.

#include <folk/python/bindings/parts.h>
#include <folk/python/players/time_out.h>

#include <folk/games/error.h>
#include <folk/games/random.h>
#include <folk/strategies/strategy.h>

#include <fmt/format.h>

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace folk::python {
namespace {

/// The strategy of a Python player. `make` gives a fresh object with move() and saw(own, theirs) and, where the flags
/// say so, belief() and new_match(rules). `time_out`, in seconds, is how long one call may last.
///
/// Its players throw what the object raises, and EnvironmentError, which names it, for an answer that is none and after
/// the time-out. A call that does not end is interrupted: in the main thread also while it waits (as in time.sleep),
/// in another as soon as it is back in Python.
struct PythonPlayers {
  std::string name;
  py::object make;
  bool deterministic = false;
  bool believes = false;
  bool told_of_matches = false;
  std::optional<double> time_out;
};

std::string shown(const py::handle& object) { return excerpt(py::repr(object).cast<std::string>()); }

/// Objects of Python go where the GIL is held, whatever thread drops the last of them.
void drop(PythonPlayers* players) {
  const py::gil_scoped_acquire acquired;
  delete players;
}

/// What a match is, as new_match(rules) is told.
py::object rules_of(const MatchStart& match) {
  py::dict payoffs;
  for (const auto& [letter, value] : {std::pair{"T", match.payoffs.temptation}, std::pair{"R", match.payoffs.reward},
                                      std::pair{"P", match.payoffs.punishment}, std::pair{"S", match.payoffs.sucker}})
    payoffs[letter] = to_double(value);
  const py::object rounds = match.criterion.is_finite() ? py::object(py::int_(match.criterion.rounds())) : py::none();
  return py::module_::import("folk.players")
      .attr("Rules")(payoffs, match.criterion.to_string(), rounds, RandomStream(match.random)());
}

/// An object of Python at the table. The GIL is taken for each call.
class PythonPlayer : public Player {
public:
  explicit PythonPlayer(std::shared_ptr<const PythonPlayers> players)
      : players_(std::move(players)),
        time_out_(players_->time_out) {}

  ~PythonPlayer() override {
    const py::gil_scoped_acquire acquired;
    sit_down({});
  }

  void start(const MatchStart& match) override {
    const py::gil_scoped_acquire acquired;
    sit_down(within_time("new player", [&] { return players_->make(); }));
    if (players_->told_of_matches)
      within_time("new_match()", [&] { return object_.attr("new_match")(rules_of(match)); });
  }

  Move move() override {
    const py::gil_scoped_acquire acquired;
    const py::object answer = within_time("move()", [&] { return move_(); });
    if (PyUnicode_Check(answer.ptr()) && PyUnicode_GET_LENGTH(answer.ptr()) == 1) {
      const Py_UCS4 letter = PyUnicode_READ_CHAR(answer.ptr(), 0);
      if (letter == 'C') return Move::C;
      if (letter == 'D') return Move::D;
    }
    throw EnvironmentError(fmt::format("{}: move() returned {}: expected 'C' or 'D'", players_->name, shown(answer)));
  }

  void observe(Move own, Move theirs) override {
    const py::gil_scoped_acquire acquired;
    within_time("saw()", [&] { return saw_(letter(own), letter(theirs)); });
  }

  std::optional<double> belief() const override {
    if (!players_->believes) return std::nullopt;
    const py::gil_scoped_acquire acquired;
    const py::object answer = within_time("belief()", [&] { return object_.attr("belief")(); });
    if (answer.is_none()) return std::nullopt;
    const double probability = PyFloat_AsDouble(answer.ptr());
    if (PyErr_Occurred() != nullptr)
      PyErr_Clear();
    else if (probability >= 0 && probability <= 1)
      return probability;
    throw EnvironmentError(
        fmt::format("{}: belief() returned {}: expected a probability that the other plays C, or None", players_->name,
                    shown(answer)));
  }

  std::unique_ptr<Player> clone() const override {
    const py::gil_scoped_acquire acquired;
    auto copy = std::make_unique<PythonPlayer>(players_);
    copy->sit_down(py::module_::import("copy").attr("deepcopy")(object_));
    return copy;
  }

private:
  static py::handle letter(Move move) {
    static const std::array<PyObject*, 2> letters{PyUnicode_InternFromString("C"), PyUnicode_InternFromString("D")};
    return letters[bit(move)];
  }

  void sit_down(py::object object) {
    object_ = std::move(object);
    move_ = object_ ? py::object(object_.attr("move")) : py::object();
    saw_ = object_ ? py::object(object_.attr("saw")) : py::object();
  }

  template <class Call>
  py::object within_time(const char* what, Call&& call) const {
    const auto refuse = [&] {
      return EnvironmentError(fmt::format("{}: {} did not return within {} s; its time_out says how long it may take",
                                          players_->name, what, *players_->time_out));
    };
    time_out_.begin();
    try {
      py::object result = call();
      if (time_out_.end()) throw refuse();
      return result;
    } catch (py::error_already_set&) {
      if (time_out_.end()) throw refuse();
      throw;
    }
  }

  std::shared_ptr<const PythonPlayers> players_;
  mutable TimeOut time_out_;
  py::object object_;
  py::object move_;
  py::object saw_;
};

Strategy strategy_of(PythonPlayers players) {
  Strategy strategy;
  strategy.name = players.name;
  strategy.deterministic = players.deterministic;
  const std::shared_ptr<const PythonPlayers> kept(new PythonPlayers(std::move(players)), drop);
  strategy.make_player = [kept] { return std::make_unique<PythonPlayer>(kept); };
  return strategy;
}

}  // namespace

void add_players(py::module_& module) {
  module.def(
      "player_strategy",
      [](std::string name, py::object make, bool deterministic, bool believes, bool told_of_matches,
         std::optional<double> time_out) {
        return strategy_of({std::move(name), std::move(make), deterministic, believes, told_of_matches, time_out});
      },
      "The strategy of a player that is written in Python; folk.players makes it.", py::arg("name"), py::arg("make"),
      py::arg("deterministic"), py::arg("believes"), py::arg("told_of_matches"), py::arg("time_out"));
}

}  // namespace folk::python
