#pragma once
// Is a pair of strategies in equilibrium? The gaps of every notion, for both sides, by the most exact way there is.

#include <folk/analysis/equilibria/gap.h>
#include <folk/analysis/equilibria/prepared_pair.h>
#include <folk/analysis/play/play_path.h>
#include <folk/analysis/replies/class_replies.h>
#include <folk/analysis/replies/prepared_machine.h>
#include <folk/games/match_rules.h>
#include <folk/games/progress.h>
#include <folk/strategies/strategy.h>

#include <optional>
#include <vector>

namespace folk {

/// What is asked of a pair. Under noise the moves of a deviation slip as all moves do, and noise 1 is refused: then
/// nothing is left to chance, and who means the other move everywhere plays without it.
struct EquilibriumQuestion : MatchRules {
  std::vector<Strategy> beliefs;  ///< the class of machines that either side may hold the other to be
  unsigned horizon = 0;           ///< rounds that machines without end are followed, under criteria without end
};

/// What one side can gain, notion by notion; nothing where a notion does not apply or cannot be decided.
struct SideGaps {
  std::optional<Gap> nash;
  std::optional<Gap> subgame_perfect;
  std::optional<Gap> self_confirming_unrestricted;
  std::optional<Gap> self_confirming_class;
  std::optional<Gap> self_confirming_own;  ///< of a player that holds beliefs (own_belief_gap.h)
};

struct PairGaps {
  SideGaps first;
  SideGaps second;
};

/// The class that the question names. Whoever asks the same of many pairs keeps it, so that the best reply to a member
/// is found once, and prepares its pairs with machines(); the calls without it make their own.
ClassReplies class_replies(const EquilibriumQuestion& question);

/// Two machines, prepared under the rules of `beliefs`. Under noise every history comes about: no belief is free, so
/// that the self-confirming gaps are the Nash gap, and exact is only a 0 that
/// subgame_perfect_gaps proves. Throws UsageError on pairs too large to solve;
/// Cancelled.
PairGaps pair_gaps(const PreparedPair& pair, ClassReplies& beliefs, const Progress& progress = nullptr);

/// The same where the two sides have classes of their own to believe in: the first player's is `beliefs`.
PairGaps pair_gaps(const PreparedPair& pair, ClassReplies& beliefs, ClassReplies& their_beliefs,
                   const Progress& progress = nullptr);

/// The same, made ready here. Throws UsageError as PreparedPair does, too.
PairGaps pair_gaps(const Machine& first, const Machine& second, const EquilibriumQuestion& question,
                   const Progress& progress = nullptr);
PairGaps pair_gaps(const Machine& first, const Machine& second, const EquilibriumQuestion& question,
                   ClassReplies& beliefs, const Progress& progress = nullptr);

/// A match under finite:T that was really played without chance and noise; a side that is no machine is null. What can
/// be gained against such a side is not known, nor is subgame perfection.
PairGaps match_gaps(const PlayPath& match, PreparedMachine* first, PreparedMachine* second, ClassReplies& beliefs,
                    const Progress& progress = nullptr);
PairGaps match_gaps(const PlayPath& match, PreparedMachine* first, PreparedMachine* second, ClassReplies& beliefs,
                    ClassReplies& their_beliefs, const Progress& progress = nullptr);
PairGaps match_gaps(const PlayPath& match, const Machine* first, const Machine* second,
                    const EquilibriumQuestion& question, const Progress& progress = nullptr);
PairGaps match_gaps(const PlayPath& match, const Machine* first, const Machine* second,
                    const EquilibriumQuestion& question, ClassReplies& beliefs, const Progress& progress = nullptr);

}  // namespace folk
