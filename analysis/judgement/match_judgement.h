#pragma once
// One recorded match: whom the player may have met, what a best reply to each would have earned, and whether the play
// can be a best reply to beliefs that agree with the match.

#include <folk/analysis/equilibria/gap.h>
#include <folk/analysis/judgement/candidates.h>
#include <folk/analysis/judgement/recorded_play.h>
#include <folk/games/integer.h>
#include <folk/games/payoffs.h>
#include <folk/games/progress.h>
#include <folk/games/rational.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// What the best reply to somebody would have earned over the rounds of a match, and how much more that is than what
/// was earned.
struct Regret {
  double best = 0;  ///< expected, where the opponent mixes or slips: then the regret may be below 0, by luck
  double regret = 0;
  std::optional<Rational> exact{};  ///< the regret, where nothing happens by chance
};

/// A behaviour of the candidates (by its place) that could have played as the other side did.
struct PossibleOpponent {
  std::size_t behaviour = 0;
  bool certain = false;            ///< it could have played nothing else
  std::optional<Regret> regret{};  ///< nothing for an opaque player, and where the question is too large
};

/// The candidate that most likely was met, slips allowed.
struct LikelyOpponent {
  std::size_t candidate = 0;       ///< behaviours in their order, then classes
  double probability = 0;          ///< given the match
  double slip = 0;                 ///< the rate that goes with it best
  std::optional<Regret> regret{};  ///< to one that slips at this rate; not where it is known from a PossibleOpponent
};

struct MatchJudgement {
  std::string name;
  std::uint64_t rounds = 0;
  Rational own_total;
  Rational their_total;
  std::vector<PossibleOpponent> consistent;  ///< without a slip
  std::vector<Integer> consistent_members;   ///< of each class of the candidates
  std::optional<LikelyOpponent> likeliest;   ///< nothing where no slip rate makes the match possible

  /// What the player could still have gained under finite:T, T being the rounds of the match:
  Gap free_beliefs;                  ///< whatever it believes of histories that did not come about (unrestricted_gap)
  std::optional<Gap> class_beliefs;  ///< believing in a `certain` opponent: the least of them (class_gap)
  std::uint64_t stated = 0;          ///< rounds with a stated belief
  std::uint64_t right = 0;           ///< of these, rounds in which the move that was held likelier was made
};

/// Judges each match by itself: the opponent of one need not be that of another. The answer depends on no number of
/// threads. Throws as agreement_with does, UsageError for payoffs that do not add up exactly, and Cancelled.
std::vector<MatchJudgement> judge_matches(const Candidates& opponents, const std::vector<RecordedMatch>& matches,
                                          const std::vector<double>& slips, const Payoffs& payoffs, unsigned threads,
                                          const Progress& progress = nullptr);

/// What the best reply earns, expected where chance plays a part, over so many rounds with an opponent whose moves slip
/// while one's own do not.
struct BestTotal {
  double payoff = 0;
  std::optional<Rational> exact{};  ///< the same, where nothing happens by chance
};

/// Throws UsageError as FiniteBestReply does.
BestTotal best_total(const Machine& opponent, const Payoffs& payoffs, std::uint64_t rounds, double slip);

}  // namespace folk
