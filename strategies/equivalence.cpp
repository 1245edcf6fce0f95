#include <folk/strategies/equivalence.h>

#include <algorithm>
#include <cstdint>
#include <unordered_set>

namespace folk {
namespace {

struct JointState {
  State a;
  State b;

  bool operator==(const JointState&) const = default;
};

struct JointStateHash {
  std::size_t operator()(const JointState& states) const {
    // Two odd multipliers and a fold of the high bits: states are small numbers, often equal to each other.
    const std::uint64_t mixed = (states.a * 0x9E3779B97F4A7C15U) ^ ((states.b + 1) * 0xC2B2AE3D27D4EB4FU);
    return static_cast<std::size_t>(mixed ^ (mixed >> 29U));
  }
};

/// A joint state and how the walk first came to it.
struct Visit {
  JointState states;
  std::size_t before;  ///< index of the visit it came from
  std::size_t rounds;  ///< length of the play that led here
  Outcome round;       ///< the last round of that play
};

std::vector<Outcome> play_to(const std::vector<Visit>& visits, std::size_t last) {
  std::vector<Outcome> play;
  for (std::size_t at = last; at != 0; at = visits[at].before) play.push_back(visits[at].round);
  std::reverse(play.begin(), play.end());
  return play;
}

}  // namespace

Comparison compare(const Machine& a, const Machine& b, Sense sense, std::size_t most_pairs) {
  std::vector<Visit> visits{{{a.start(), b.start()}, 0, 0, {}}};
  std::unordered_set<JointState, JointStateHash> known{visits.front().states};
  Comparison result;
  const auto differ = [&](std::size_t at) {
    const auto [first, second] = visits[at].states;
    result.first = a.cooperation(first);
    result.second = b.cooperation(second);
    return result.first != result.second;
  };
  const auto conclude = [&](Equivalence equivalence, std::size_t depth) {
    result.equivalence = equivalence;
    result.pairs = visits.size();
    result.depth = depth;
    return result;
  };
  if (differ(0)) return conclude(Equivalence::different, 0);
  for (std::size_t at = 0; at < visits.size(); ++at) {
    const Visit here = visits[at];
    const double cooperation = a.cooperation(here.states.a);  // equal to b's
    for (const Outcome round : all_outcomes) {
      if (!possible(cooperation, round, sense)) continue;
      const auto [own, theirs] = round;
      const JointState then{a.next(here.states.a, own, theirs), b.next(here.states.b, own, theirs)};
      if (known.contains(then)) continue;
      if (visits.size() >= most_pairs) return conclude(Equivalence::undecided, here.rounds);
      known.insert(then);
      visits.push_back({then, at, here.rounds + 1, round});
      if (!differ(visits.size() - 1)) continue;
      result.play = play_to(visits, visits.size() - 1);
      return conclude(Equivalence::different, here.rounds + 1);
    }
  }
  return conclude(Equivalence::equivalent, visits.back().rounds);
}

}  // namespace folk
