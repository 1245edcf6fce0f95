#pragma once
// Matches that show what follows whatever one does, with the beliefs that were right in them: what a policy needs that
// acts on its beliefs alone.

#include <folk/analysis/replies/opponent_prior.h>
#include <folk/analysis/replies/posterior.h>
#include <folk/games/payoffs.h>
#include <folk/games/random.h>
#include <folk/sct/data/windows.h>

#include <cstdint>
#include <vector>

namespace folk::sct {

/// An endless row of matches against opponents drawn from a prior. The learner's seat is taken by turns by a planner,
/// who plays the best reply of 2 to 4 rounds to the posterior, and by strategies of the prior that relieve each other;
/// both slip: so that what follows a defection, a punishment, a mistake has been seen. Each round is labelled with the
/// posterior's belief (Lesson::beliefs) and with the best reply to it (Lesson::wanted). Return tokens are 0.
class Exploration {
public:
  /// Members of the prior's classes are met only when they are in `Half::trained`. Throws as Posterior does.
  Exploration(OpponentPrior prior, const Payoffs& payoffs, std::uint64_t rounds);

  /// Matches [first, first + count) of the row that `seed` draws, whatever else is drawn.
  std::vector<Lesson> matches(std::uint64_t seed, std::uint64_t first, std::uint64_t count, unsigned threads) const;

private:
  Lesson match(std::uint64_t seed, std::uint64_t number) const;
  std::shared_ptr<const Machine> somebody(RandomStream& random) const;

  OpponentPrior prior_;
  Posterior posterior_;
  std::array<double, 4> payoffs_;
  std::uint64_t rounds_;
  double weight_ = 0;
};

}  // namespace folk::sct
