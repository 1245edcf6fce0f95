#include <folk/tools/strategy_graph/drawn.h>

#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/standard_names.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <optional>
#include <utility>

namespace folk::tools {
namespace {

/// More circles than this are no picture.
constexpr std::size_t most_drawn = 300;

/// Machines with more states than this are not minimised.
constexpr std::size_t most_searched = 100'000;

/// The smallest automaton of a finite machine, or nothing when it has too many states to find out.
std::optional<Automaton> smallest_automaton(const Machine& machine, Sense sense) {
  if (!machine.finite()) return std::nullopt;
  const auto table = tabulate(machine, sense, most_searched);
  if (!table) return std::nullopt;
  return minimise(*table, sense);
}

/// The first `horizon` rounds of a machine.
Automaton first_rounds(const Machine& machine, Sense sense, unsigned horizon) {
  if (const auto smallest = smallest_automaton(machine, sense)) return unroll(*smallest, sense, horizon);
  // States are told apart by what follows the horizon as well: a cut there alone would merge states (soft_majo's
  // leads, gradual's counts) only because the picture ends.
  const unsigned look_ahead = horizon + 4;
  return unroll(minimise(unroll(machine, sense, horizon + look_ahead, most_searched), sense), sense, horizon);
}

Automaton drawn_automaton(const std::string& name, const Machine& machine, Sense sense, unsigned horizon) {
  const auto refuse = [&](const std::string& what, const std::string& mend) {
    return UsageError(fmt::format("{}, more than the {} that make a picture: {}", what, most_drawn, mend));
  };
  if (horizon > 0) {
    Automaton cut = first_rounds(machine, sense, horizon);
    if (cut.size() <= most_drawn) return cut;
    throw refuse(fmt::format("the first {} rounds of {} have {} states", horizon, name, cut.size()),
                 "give a smaller --horizon");
  }
  if (!machine.finite())
    throw UsageError(fmt::format("{} has infinitely many states: draw its first N rounds with --horizon N", name));
  auto smallest = smallest_automaton(machine, sense);
  if (smallest && smallest->size() <= most_drawn) return *std::move(smallest);
  throw refuse(fmt::format("{} has {} states", name,
                           smallest ? std::to_string(smallest->size()) : fmt::format("over {}", most_searched)),
               "draw its first N rounds with --horizon N");
}

/// True when the strategy of this name would be another one in another dilemma: then its automaton has a game. Those of
/// files have none, and the standard input can be read only once.
bool depends_on_payoffs(const Machine& machine, const std::string& name, const Payoffs& payoffs) {
  if (machine.deterministic() || name.find('@') != std::string::npos) return false;
  Payoffs other = payoffs;
  other.temptation += 1;
  try {
    const Strategy same_name = standard_names().make(name, other);
    const auto table = [](const Machine& one) { return tabulate(one, Sense::any_own_moves, most_searched); };
    return !same_name.machine || table(*same_name.machine) != table(machine);
  } catch (const UsageError&) {
    return true;  // there is none such in the other
  }
}

}  // namespace

Drawn drawn(const Strategy& strategy, const std::string& name, Sense sense, unsigned horizon, const Payoffs& payoffs) {
  Automaton automaton = drawn_automaton(strategy.name, *strategy.machine, sense, horizon);
  DrawingOptions drawing{strategy.name, sense, horizon, names_behind(automaton, *strategy.machine, sense)};
  if (depends_on_payoffs(*strategy.machine, name, payoffs))
    drawing.caption.game = game_words(ChosenGame{}.title, payoffs);
  return {std::move(automaton), std::move(drawing)};
}

}  // namespace folk::tools
