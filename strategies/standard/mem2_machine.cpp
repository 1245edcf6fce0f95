#include <folk/games/outcome.h>
#include <folk/strategies/standard/mem2_machine.h>

#include <array>

namespace folk {
namespace {

struct Plan {
  enum : unsigned { tit_for_tat = 0, tit_for_two_tats = 1, all_d = 2, all_d_for_ever = 3 };
};

/// What mem2 keeps of a match.
struct Memo {
  unsigned plan = Plan::tit_for_tat;
  unsigned last = 0;           // outcome of the last round
  unsigned before = 0;         // outcome of the round before
  bool odd = false;            // an odd number of rounds has been played
  bool defected_once = false;  // all_d has been chosen once
  bool late = false;           // two rounds have been played

  State pack() const {
    return plan | (last << 2U) | (before << 4U) | (unsigned{odd} << 6U) | (unsigned{defected_once} << 7U) |
           (unsigned{late} << 8U);
  }
  static Memo unpack(State state) {
    const auto s = static_cast<unsigned>(state);
    return {s & 3U, (s >> 2U) & 3U, (s >> 4U) & 3U, (s & 64U) != 0, (s & 128U) != 0, (s & 256U) != 0};
  }

  void choose(bool by_payoffs) {
    constexpr std::array<unsigned, 4> points{3, 0, 5, 1};
    const unsigned sum = points[last] + points[before];
    const bool both_cooperated = by_payoffs ? sum == 6 : last == 0 && before == 0;
    const bool took_turns = by_payoffs ? sum == 5 : last != before && last + before == 3 && last != 0 && before != 0;
    if (both_cooperated) {
      plan = Plan::tit_for_tat;
    } else if (took_turns) {
      plan = Plan::tit_for_two_tats;
    } else {
      plan = defected_once ? Plan::all_d_for_ever : Plan::all_d;
      defected_once = true;
    }
  }
};

}  // namespace

State Mem2Machine::start() const { return Memo{}.pack(); }

double Mem2Machine::cooperation(State state) const {
  const Memo memo = Memo::unpack(state);
  const bool last_defected = all_outcomes[memo.last].theirs == Move::D;
  const bool before_defected = all_outcomes[memo.before].theirs == Move::D;
  switch (memo.plan) {
    case Plan::tit_for_tat: return last_defected ? 0 : 1;
    case Plan::tit_for_two_tats: return last_defected && before_defected ? 0 : 1;
    default: return 0;
  }
}

State Mem2Machine::next(State state, Move own, Move theirs) const {
  Memo memo = Memo::unpack(state);
  if (memo.plan == Plan::all_d_for_ever) return Memo{.plan = Plan::all_d_for_ever}.pack();
  memo.before = memo.last;
  memo.last = static_cast<unsigned>(Outcome{own, theirs}.index());
  memo.odd = !memo.odd;
  if (memory_ == Memory::stored_twice && memo.late) memo.before = memo.last;
  if (!memo.odd || (memory_ == Memory::stored_twice && memo.late)) memo.choose(memory_ == Memory::stored_twice);
  if (memory_ == Memory::stored_twice && !memo.odd) memo.late = true;
  if (memo.plan == Plan::all_d_for_ever) return Memo{.plan = Plan::all_d_for_ever}.pack();
  return memo.pack();
}

}  // namespace folk
