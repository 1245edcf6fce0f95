#pragma once
// Whom one may meet, and how likely each is.

#include <folk/strategies/registry.h>
#include <folk/strategies/standard/memory_class.h>
#include <folk/strategies/strategy.h>

#include <string_view>
#include <vector>

namespace folk {

/// Machines and complete classes with their weights, which need not add up to 1.
struct OpponentPrior {
  struct Known {
    Strategy strategy;  ///< a machine (an opaque player only from read_weighted_roster)
    double weight = 1;
  };
  struct Class {
    MemoryClass members;  ///< as likely as each other
    double weight = 1;    ///< of all of them together
  };
  std::vector<Known> known;
  std::vector<Class> classes;
  double slip = 0;  ///< probability that a move of whoever is met slips, from 0 to less than 0.5
};

/// Each strategy of the roster as likely as another. Throws UsageError when it is empty or holds an opaque player.
OpponentPrior equal_prior(const std::vector<Strategy>& roster);

/// Reads a SPEC whose items may have weights, "3*sct2025,memory(2,2)": what W*ITEM stands for weighs W in all, shared
/// alike; a strategy without a weight weighs 1. An item memory(X,Y) becomes a class, however large. Throws what
/// Registry::roster and equal_prior throw, and UsageError for a weight that is no number above 0.
OpponentPrior read_prior(const Registry& registry, std::string_view spec, const Payoffs& payoffs);

/// The same, opaque players included: for who tells machines and players apart by itself.
OpponentPrior read_weighted_roster(const Registry& registry, std::string_view spec, const Payoffs& payoffs);

/// True when an item of the SPEC has a weight.
bool has_weights(std::string_view spec);

}  // namespace folk
