#include <folk/games/error.h>
#include <folk/games/payoffs.h>
#include <folk/games/stage_games/reference_games.h>

namespace folk {
namespace {

const MixedAction first{1, 0};
const MixedAction second{0, 1};

MixedAction mix(const Rational& probability_of_first) { return {probability_of_first, 1 - probability_of_first}; }

/// A symmetric 2x2 game with actions of these names. Both seats have the same minmax values.
ReferenceGame symmetric(std::string name, const std::string& title, std::array<std::string, 2> actions,
                        const Payoffs& payoffs, std::string source, std::vector<MixedProfile> equilibria,
                        const Minmax& minmax) {
  const auto& [t, r, p, s] = payoffs;
  const std::vector<std::string> names(actions.begin(), actions.end());
  return {std::move(name),
          StageGame(title, {"Row", "Column"}, {names, names}, {{r, r}, {s, t}, {t, s}, {p, p}}),
          std::move(source),
          std::move(equilibria),
          {minmax, minmax}};
}

ReferenceGame prisoners_dilemma_game() {
  return symmetric("prisoners_dilemma", "Prisoner's dilemma", {"C", "D"}, {5, 3, 1, 0},
                   "T > R > P > S with the payoffs of Axelrod (1984), The Evolution of Cooperation", {{second, second}},
                   {1, 1, second, second});
}

ReferenceGame stag_hunt() {
  return symmetric("stag_hunt", "Stag hunt", {"Stag", "Hare"}, {8, 9, 7, 0},
                   "R > T > P > S with the payoffs of Aumann (1990), Nash equilibria are not self-enforcing",
                   {{first, first}, {second, second}, {mix({7, 8}), mix({7, 8})}}, {7, 7, second, second});
}

ReferenceGame chicken() {
  return symmetric("chicken", "Chicken", {"Swerve", "Straight"}, {7, 6, 0, 2},
                   "T > R > S > P with the payoffs of Aumann (1974), Subjectivity and correlation in randomized "
                   "strategies",
                   {{first, second}, {second, first}, {mix({2, 3}), mix({2, 3})}}, {2, 2, second, first});
}

ReferenceGame harmony() {
  return symmetric("harmony", "Harmony", {"C", "D"}, {3, 4, 1, 2},
                   "R > T > S > P in ranks 4 to 1: a no-conflict game of Rapoport & Guyer (1966), A taxonomy of 2x2 "
                   "games",
                   {{first, first}}, {2, 2, second, first});
}

ReferenceGame deadlock() {
  return symmetric("deadlock", "Deadlock", {"C", "D"}, {4, 2, 3, 1},
                   "T > P > R > S in ranks 4 to 1: named by Snyder & Diesing (1977), Conflict among Nations",
                   {{second, second}}, {3, 3, second, second});
}

/// Here mixing punishes harder than any pure action: 1/5 instead of 1.
ReferenceGame battle_of_the_sexes() {
  const MixedAction row = mix({3, 5});
  const MixedAction column = mix({2, 5});
  return {"battle_of_the_sexes",
          StageGame("Battle of the sexes", {"Row", "Column"}, {{{"Fight", "Ballet"}, {"Fight", "Ballet"}}},
                    {{2, 1}, {-1, -1}, {-1, -1}, {1, 2}}),
          "Payoffs of Luce & Raiffa (1957), Games and Decisions, chapter 5",
          {{first, first}, {second, second}, {row, column}},
          {{{1, {1, 5}, column, column}, {1, {1, 5}, row, row}}}};
}

ReferenceGame matching_pennies() {
  const MixedAction half = mix({1, 2});
  return {"matching_pennies",
          StageGame("Matching pennies", {"Row", "Column"}, {{{"Heads", "Tails"}, {"Heads", "Tails"}}},
                    {{1, -1}, {-1, 1}, {-1, 1}, {1, -1}}),
          "von Neumann & Morgenstern (1944), Theory of Games and Economic Behavior",
          {{half, half}},
          {{{1, 0, half, half}, {1, 0, half, half}}}};
}

/// The payoffs that the tests of QuantEcon.py's AS algorithm (quantecon/game_theory/tests/test_repeated_game.py) give
/// for the "example from Abreu and Sannikov (2014)"; the article itself was not at hand. At the discount factor 0.3
/// they find these corners of the set of subgame perfect equilibrium payoffs: (7.33770472, 10.9826253),
/// (1.12568240, 2.8), (7.33770472, 0), (7.86308964, 0), (19.7917977, 2.8), (15.5630896, 9.1).
ReferenceGame abreu_sannikov() {
  const MixedAction top{1, 0, 0};
  const MixedAction middle{0, 1, 0};
  const MixedAction bottom{0, 0, 1};
  return {"abreu_sannikov",
          StageGame("Abreu & Sannikov (2014)", {"Row", "Column"}, {{{"T", "M", "B"}, {"L", "C", "R"}}},
                    {{16, 9}, {3, 13}, {0, 3}, {21, 1}, {10, 4}, {-1, 0}, {9, 0}, {5, -4}, {-5, -15}}),
          "Abreu & Sannikov (2014), An algorithm for two-player repeated games with perfect monitoring, Theoretical "
          "Economics 9, 313-338",
          {{middle, middle}},
          {{{0, 0, bottom, top}, {0, 0, bottom, top}}}};
}

}  // namespace

const std::vector<ReferenceGame>& reference_games() {
  static const std::vector<ReferenceGame> games{
      prisoners_dilemma_game(), stag_hunt(), chicken(),  battle_of_the_sexes(),
      matching_pennies(),       harmony(),   deadlock(), abreu_sannikov(),
  };
  return games;
}

const ReferenceGame& reference_game(std::string_view name) {
  std::string names;
  for (const ReferenceGame& entry : reference_games()) {
    if (entry.name == name) return entry;
    names += (names.empty() ? "" : ", ") + entry.name;
  }
  throw UsageError("there is no reference game '" + excerpt(name) + "': take one of " + names);
}

}  // namespace folk
