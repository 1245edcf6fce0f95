#pragma once
// Everything that a record of play says: who the player may be, whom it may have met, what it could have earned, and
// what is true of its beliefs.

#include <folk/analysis/beliefs/belief_consistency.h>
#include <folk/analysis/judgement/candidates.h>
#include <folk/analysis/judgement/match_judgement.h>
#include <folk/analysis/judgement/own_judgement.h>
#include <folk/analysis/judgement/recorded_play.h>
#include <folk/analysis/judgement/stage_replies.h>
#include <folk/games/payoffs.h>
#include <folk/games/progress.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace folk {

/// What is asked about a record.
struct JudgementQuestion {
  RecordedPlay play;
  Payoffs payoffs;
  OpponentPrior players;    ///< who the recorded player may be
  OpponentPrior opponents;  ///< whom it may have met
  std::vector<double> slips = usual_slips();
  unsigned threads = 1;
};

/// What the matches say together of a reading as self-confirming play (Fudenberg & Levine 1993), for finite:T, T being
/// the rounds of each.
struct SelfConfirmingReading {
  std::size_t free = 0;      ///< matches that are a best reply to some belief which agrees with them
  std::size_t worst = 0;     ///< the match with the largest gain of free beliefs
  std::size_t of_class = 0;  ///< matches that are one to a machine of the opponents which agrees with them
  std::size_t agreed = 0;    ///< matches with which some machine of the opponents agrees for certain
  std::size_t stated = 0;    ///< matches with stated beliefs
  std::size_t right = 0;     ///< of these, matches in which every one was right
  std::size_t all = 0;       ///< of these, matches that are `free` too: nothing stated speaks against the reading
};

struct Judgement {
  Candidates players;
  Candidates opponents;
  OwnJudgement own;
  std::vector<MatchJudgement> matches;
  std::optional<BeliefConsistency> beliefs;  ///< nothing where none was stated
  std::optional<StageReplies> stage;
  SelfConfirmingReading reading;
};

/// Throws as judge_own and judge_matches do.
Judgement judge_play(const JudgementQuestion& question, const Progress& progress = nullptr);

}  // namespace folk
