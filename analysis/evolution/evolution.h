#pragma once
// A population on its way: generation after generation, to a fixed point, a cycle, or as far as it is asked to go.

#include <folk/analysis/evolution/dynamics.h>
#include <folk/analysis/evolution/population_history.h>
#include <folk/games/progress.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace folk {

/// Why an evolution goes no further.
enum class EvolutionEnd {
  none,         ///< it would go on
  fixed_point,  ///< the next generation is this one (shares: within the model's tolerance)
  cycle,        ///< a population came back, and with it all that followed
  uniform       ///< one strategy is left, none can come back
};

/// What is kept of a generation however many strategies there are.
struct GenerationSummary {
  std::uint64_t generation = 0;
  std::uint64_t living = 0;  ///< strategies
  double individuals = 0;
  std::uint64_t leader = 0;  ///< the most numerous strategy, of several the first
  double number = 0;         ///< of the leader

  bool operator==(const GenerationSummary&) const = default;
};

/// All that an evolution is, so that it can be kept and gone on with.
struct EvolutionState {
  std::uint64_t generation = 0;
  Population population;
  std::vector<std::uint64_t> extinct_at;  ///< the generation in which a strategy was first without members; 0: alive
  PopulationHistory history;
  std::vector<GenerationSummary> summaries;  ///< of generations up to 100, then 200, 300, ... 1000, 2000, and so on
  EvolutionEnd end = EvolutionEnd::none;
  std::uint64_t period = 0;  ///< of a cycle

  // Brent's search for cycles: a population that later ones are compared with, and when it was.
  std::uint64_t marked_generation = 0;
  Population marked;
};

GenerationSummary summary_of(std::uint64_t generation, const Population& population);

/// An entrant's place at the end.
struct PopulationRank {
  std::size_t rank = 0;  ///< 1 is best
  std::size_t entrant = 0;
  double population = 0;
  std::optional<std::uint64_t> extinct_at;
};

class Evolution {
public:
  /// Throws UsageError where `start` has not as many numbers as the matrix strategies, a negative number, or nobody;
  /// shares are made to add up to 1.
  Evolution(DynamicsPtr dynamics, Population start, std::uint64_t seed = 1);

  /// Runs on until `generations` generations are there or it ends. `after` is called after each generation, where
  /// given. Throws Cancelled and what the calls throw, between two generations: it can be gone on with.
  void run(std::uint64_t generations, const Progress& progress = nullptr, const std::function<void()>& after = nullptr);

  const EvolutionState& state() const { return state_; }

  /// Goes on from a state of the same evolution.
  void restore(EvolutionState state) { state_ = std::move(state); }

  /// Best first: the living by their numbers, then the dead, who died later first; equal ones in roster order.
  std::vector<PopulationRank> ranking() const;

  /// 64 bits of what it is (model, start, seed where it counts), not of how far it got.
  std::uint64_t identity() const;

  const Dynamics& dynamics() const { return *dynamics_; }
  std::uint64_t seed() const { return seed_; }

private:
  void look_for_end(const Population& before);

  DynamicsPtr dynamics_;
  Population start_;
  std::uint64_t seed_;
  EvolutionState state_;
};

}  // namespace folk
