#pragma once
// What a round robin looks like from every seat: the data that the paper trains on.

#include <folk/analysis/play/sampling.h>
#include <folk/games/payoffs.h>
#include <folk/sct/data/trajectory.h>
#include <folk/strategies/strategy.h>

#include <cstdint>
#include <vector>

namespace folk::sct {

/// One trajectory for every ordered pair of the roster, self-play included: both sides of every pair.
/// Where chance has a part, give `repetitions`; match r draws from match_key(seed, pair, r, role).
std::vector<Trajectory> tournament_data(const std::vector<Strategy>& roster, const Payoffs& payoffs,
                                        std::uint64_t rounds, Repetitions repetitions = 1, std::uint64_t seed = 1);

}  // namespace folk::sct
