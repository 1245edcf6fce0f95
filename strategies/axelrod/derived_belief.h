#pragma once
// DBS, the derived belief strategy: it learns rules of the opponent's play, tells slips from changes of mind, and plans
// ahead (Au & Nau, AAMAS 2006).

#include <folk/strategies/axelrod/record.h>

#include <array>
#include <optional>
#include <vector>

namespace folk {

/// For each outcome of a round (CC, CD, DC, DD) it holds a rule, what they play next: a current one, or a default one
/// from before the last change, or else the discounted frequency of their C.
class DerivedBelief {
public:
  Move move() const;
  void observe(Move own, Move theirs);

private:
  /// What followed an outcome: an entry a round from the second on, after one that is assumed.
  struct Followed {
    std::vector<bool> cooperated;
    std::vector<bool> occurred;
  };
  using Rules = std::array<std::optional<Move>, 4>;

  void record_answer(std::size_t outcome, Move theirs);
  bool to_be_promoted(std::size_t outcome, Move theirs) const;
  double frequency(std::size_t outcome) const;
  void revise_rules(std::size_t outcome, Move theirs);
  double value(std::size_t outcome, unsigned depth) const;
  double value_of_move(Move own, std::size_t outcome, unsigned depth) const;

  Record record_;
  std::array<Followed, 4> followed_{Followed{{true}, {true}}, Followed{{true}, {true}}, Followed{{false}, {true}},
                                    Followed{{false}, {true}}};
  Rules default_{Move::C, Move::C, Move::D, Move::D};
  Rules current_;
  std::array<unsigned, 4> violations_{};
  unsigned rejections_ = 0;
  std::array<double, 4> cooperation_{1, 1, 0, 0};  // P(they play C) after each outcome, by all of the above
};

}  // namespace folk
