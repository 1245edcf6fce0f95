#pragma once
// The member of a class that earns most against all of them.

#include <folk/analysis/classes/class_score.h>

#include <cstdint>
#include <string>

namespace folk {

/// How a champion is looked for. A member that tells more than most_leaves kinds of opponents apart is passed over.
struct ChampionSettings : ClassScoreSettings {
  ChampionSettings() { most_leaves = 200'000; }

  std::uint64_t seed = 1;
  std::uint64_t evaluations = 20'000;  ///< members that are scored, where the class cannot be gone through
};

struct Champion {
  std::string member;
  ClassScore score;
  bool proved = false;             ///< no member earns more
  std::uint64_t equals = 0;        ///< members that earn as much, itself among them; 0 where not proved
  std::uint64_t evaluations = 0;   ///< members that were scored
  std::uint64_t passed_over = 0;   ///< members that told too many kinds of opponents apart
  std::uint64_t local_optima = 0;  ///< found on the way: no single gene that play asks for is better turned over
};

/// Classes up to X + Y = 4 are ranked as a whole, which proves the champion (of equals the first in the order of the
/// class). In larger ones it is looked for by iterated local search (Lourenco, Martin & Stuetzle 2003) over genes that
/// play asks for, in eight searches apart from each other, with the exact score against the class: what is found is a
/// local optimum, not more. The result does not depend on the number of threads. Throws what play_class and
/// score_against throw; TooManyKinds where no member could be scored.
Champion champion_of(const MemoryClass& members, const ChampionSettings& settings, const Progress& progress = nullptr);

}  // namespace folk
