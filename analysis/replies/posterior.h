#pragma once
// What a play reveals about whom one has met, and looking ahead a few rounds on it.

#include <folk/analysis/replies/class_posterior.h>
#include <folk/analysis/replies/opponent_prior.h>
#include <folk/games/move.h>
#include <folk/strategies/machine.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace folk {

/// Bayes' rule over machines, which may mix and count, and over complete classes: every round multiplies the weight of
/// each by the probability of the move that was seen. Where moves slip, what has become less likely than 10^-12 is
/// forgotten.
class Posterior {
public:
  /// Throws UsageError on a prior of nobody, or with a weight or slip that is out of range.
  explicit Posterior(OpponentPrior prior);

  /// A new match: everybody is as likely as the prior says, at its start.
  void reset();

  /// False when nobody of the prior would have played so.
  bool possible() const { return !members_.machines.empty() || !members_.classes.empty(); }

  /// P(the opponent plays C now); it must be possible().
  double cooperation() const;

  /// What was really played.
  void observe(Move own, Move theirs);

  /// The expected payoff of the next `depth` rounds when one's own move is C and when it is D, the rest being played
  /// best; a round weighs `continuation` times the one before. A move of theirs that is less likely than
  /// `least_probability` is taken to lead where the likelier one does. Takes up to 4^depth steps for each member
  /// (2^depth for one that neither mixes nor slips).
  std::array<double, 2> action_values(const std::array<double, 4>& payoffs, unsigned depth, double continuation,
                                      double least_probability = 0) const;

private:
  struct Member {
    const Machine* machine;
    State state;
    double weight;
  };
  struct ClassMember {
    ClassPosterior known;
    double weight;
  };
  struct Members {
    std::vector<Member> machines;
    std::vector<ClassMember> classes;
  };
  struct Chances {
    double all;
    double cooperating;
  };
  struct Search {
    const std::array<double, 4>& payoffs;
    double continuation;
    double least_probability;
  };

  /// As action_values, the weights not being divided by their sum; `rooms[0]` is where the next round's members go.
  std::array<double, 2> totals(const Members& members, const Search& search, unsigned depth, Members* rooms) const;

  Chances chances(const Members& members) const;
  double slipped(double cooperation) const;

  /// Those that play `theirs` now, with their weights and states after the round.
  void consistent(const Members& members, Move own, Move theirs, Members& left) const;

  /// Of the members those of at least this weight.
  static Members likely(const Members& members, double weight);

  OpponentPrior prior_;
  Members members_;
};

}  // namespace folk
