#pragma once
// What a match is played for: who asks about matches takes these, so that no setting is handed on by its position.

#include <folk/games/criterion.h>
#include <folk/games/noise.h>
#include <folk/games/payoffs.h>

namespace folk {

/// None of the three can hold a wrong value, and so neither can the rules.
struct MatchRules {
  Payoffs payoffs;
  Criterion criterion = Criterion::finite(100);
  Noise noise{};  ///< every move of both sides flips with this probability
};

}  // namespace folk
