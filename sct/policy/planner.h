#pragma once
// A best reply to what a policy believes: its own next moves, searched over what it believes of the other's after each.

#include <folk/sct/network/branches.h>
#include <folk/sct/policy/thinker.h>

#include <array>
#include <cstddef>
#include <vector>

namespace folk::sct {

/// How far, and how much of it, is looked at.
struct PlanSettings {
  unsigned depth = default_plan_depth;  ///< rounds, 1 to most_plan_depth; fewer are left at the end of finite:T
  /// A move of the other's that is less likely than this is taken to lead where its likelier move leads.
  double least_probability = 0.01;
  double continuation = 1;  ///< what a round weighs against the one before
};

/// What the next rounds are worth.
struct Plan {
  double belief = 0.5;             ///< P(the opponent plays C)
  std::array<double, 2> values{};  ///< expected payoff of the rounds looked at when one's own move is C, is D
  std::size_t situations = 1;      ///< in which the network was asked for its belief

  /// The move that is worth more, C where both are worth the same up to the rounding of the network.
  Move better() const;
};

/// A belief that a plan is made on whatever the network believes.
struct ForcedBelief {
  Move move = Move::C;     ///< the other's, held for certain
  bool throughout = true;  ///< in every round that is looked at; else in the present one alone
};

/// Expectimax over beliefs: V_1(x) = max over m of E u(m, their move), V_h(x) = max over m of E [u(m, their move) +
/// continuation V_{h-1}(x after both moves)], the other moving as the network believes in the situation x, which holds
/// all that was played and, further on, might be. What is beyond the last round counts nothing.
class Planner {
public:
  /// `mind` must outlive this. Throws UsageError for a depth out of range.
  Planner(const Mind& mind, const PlanSettings& settings);

  /// The next rounds of a match of which at most `left` are left; `payoffs` by outcome. `thinker` thinks of the
  /// present.
  Plan plan(Thinker& thinker, const MatchSoFar& so_far, const std::array<double, 4>& payoffs, unsigned left,
            std::optional<ForcedBelief> forced = std::nullopt);

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Situation {
    double belief = 0.5;
    float asked = 0;                                          // the return token
    std::vector<std::uint8_t> seen{};                         // the observations that the present one tells of
    std::array<std::size_t, 4> next{none, none, none, none};  // in the next level, by outcome
  };
  using Level = std::vector<Situation>;

  void look_further(std::size_t round, const std::array<double, 4>& payoffs, std::optional<ForcedBelief> forced);
  Matrix<float> tokens(std::size_t round, const std::vector<std::size_t>& outcomes, const Level& situations) const;
  std::array<double, 2> values(const Situation& situation, const std::vector<double>& next,
                               const std::array<double, 4>& payoffs) const;

  const Mind& mind_;
  PlanSettings settings_;
  Heads<float> heads_;  // on observations alone
  Branches branches_;
  std::vector<Level> levels_;
};

}  // namespace folk::sct
