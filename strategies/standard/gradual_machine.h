#pragma once
// gradual and its variants: punish longer each time, then calm down (Beaufils, Delahaye & Mathieu 1996).

#include <folk/strategies/machine.h>

namespace folk {

/// C until provoked; then n times D, C, C, and it watches their last move again.
class GradualMachine final : public Machine {
public:
  enum class Counts {
    every_defection,   ///< n = all their D so far (Mathieu & Delahaye 2017)
    provocations_only  ///< n = the D that provoked it (the 1997 paper's row; Axelrod-Python's OriginalGradual)
  };
  enum class Calm {
    watches_second_round,  ///< a D in the second of the two calming rounds provokes
    ignores_both_rounds    ///< it does not (the program published with arXiv 2310.04579)
  };

  GradualMachine(Counts counts, Calm calming)
      : counts_(counts),
        calm_(calming) {}

  State start() const override { return pack(watch, 0, 0); }
  double cooperation(State state) const override { return phase(state) >= punish ? 0 : 1; }
  State next(State state, Move own, Move theirs) const override;
  bool finite() const override { return false; }
  CounterView view(State state) const override;
  State state_of(const CounterView& view) const override;

private:
  // Phases; `last` is the last D of a punishment, so that `punish` always leads on to another D.
  enum Phase : unsigned { watch = 0, calm = 1, punish = 2, last = 3 };

  // A state: phase (2 bits), defections counted (31 bits), D left to play in phase `punish` (31 bits).
  static State pack(Phase phase, std::int64_t defections, std::int64_t left);
  static Phase phase(State state) { return static_cast<Phase>(state >> 62U); }
  static std::int64_t defections(State state) { return static_cast<std::int64_t>((state >> 31U) & most); }
  static std::int64_t left(State state) { return static_cast<std::int64_t>(state & most); }
  static constexpr std::uint64_t most = 0x7FFFFFFFU;

  Counts counts_;
  Calm calm_;
};

}  // namespace folk
