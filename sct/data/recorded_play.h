#pragma once
// Matches recorded move by move, as data to learn from.

#include <folk/analysis/play/sampling.h>
#include <folk/games/payoffs.h>
#include <folk/sct/data/trajectory.h>
#include <folk/strategies/strategy.h>

#include <cstdint>
#include <vector>

namespace folk::sct {

/// Matches of a player against each member of a roster. Its moves slip with probability `slip`, the opponents' never
/// do; match r against member i draws from match_key(seed, i, r, role).
std::vector<Trajectory> play_and_record(const Strategy& player, const std::vector<Strategy>& roster,
                                        const Payoffs& payoffs, std::uint64_t rounds, Noise slip,
                                        Repetitions repetitions, std::uint64_t seed, unsigned threads = 1);

/// The best reply to each (deterministic) member, known in advance, played against it.
std::vector<Trajectory> best_reply_data(const std::vector<Strategy>& roster, const Payoffs& payoffs,
                                        std::uint64_t rounds);

}  // namespace folk::sct
