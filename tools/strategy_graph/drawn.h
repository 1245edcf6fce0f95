#pragma once
// What is drawn of a strategy.

#include <folk/analysis/pictures/drawing.h>
#include <folk/games/payoffs.h>
#include <folk/strategies/strategy.h>

#include <string>

namespace folk::tools {

struct Drawn {
  Automaton automaton;
  DrawingOptions options;
};

/// The smallest automaton of a machine in this sense, or with a horizon its first rounds, and the words of the drawing.
/// `name` is what the strategy was asked for as. Throws UsageError where it would have too many states.
Drawn drawn(const Strategy& strategy, const std::string& name, Sense sense, unsigned horizon, const Payoffs& payoffs);

}  // namespace folk::tools
