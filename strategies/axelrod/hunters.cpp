#include <folk/strategies/axelrod/cycles.h>
#include <folk/strategies/axelrod/hunters.h>

#include <cmath>

namespace folk {

void CycleHunter::observe(Move, Move theirs) {
  theirs_.add(theirs);
  const bool constant = theirs_.defections() == 0 || theirs_.cooperations() == 0;
  if (!found_ && !constant) {
    const std::size_t length = cycle_length(theirs_, 0, 3);
    found_ = length > 0;
  }
}

Move EventualCycleHunter::move() const {
  return found_ && theirs_.size() >= 10 && theirs_.defections() > 0 ? Move::D : Move::C;
}

void EventualCycleHunter::observe(Move, Move theirs) {
  theirs_.add(theirs);
  if (theirs_.size() % 10 == 0 && theirs_.defections() > 0) found_ = cycle_length(theirs_, 10, 3) > 0;
}

double MathConstantHunter::cooperation(std::size_t from, std::size_t to) const {
  const std::size_t count = record_.own.cooperations(from, to) + record_.theirs.cooperations(from, to);
  return 0.5 * static_cast<double>(count) / static_cast<double>(to - from);
}

Move MathConstantHunter::move() const {
  const std::size_t n = record_.rounds();
  if (n < 8 || record_.theirs.cooperations() == 0 || record_.theirs.defections() == 0) return Move::C;
  const double first = cooperation(0, n / 2);
  const double middle = cooperation(n / 4, 3 * n / 4);
  const double second = cooperation(n / 2, n);
  return std::abs(first - middle) < 0.2 && std::abs(first - second) < 0.2 ? Move::D : Move::C;
}

void RandomHunter::observe(Move own, Move theirs) {
  if (record_.rounds() > 0) {
    const Move asked = record_.own.last();
    if (asked == theirs) ++(asked == Move::C ? cooperation_answered_ : defection_answered_);
  }
  record_.add(own, theirs);
}

Move RandomHunter::move() const {
  if (record_.rounds() <= 10) return Move::C;
  bool tried = false;
  const auto random = [&](std::size_t answered, std::size_t asked) {
    if (asked <= 5) return true;
    tried = true;
    return std::abs(static_cast<double>(answered) / static_cast<double>(asked) - 0.5) < 0.25;
  };
  const bool both = random(cooperation_answered_, record_.own.cooperations()) &&
                    random(defection_answered_, record_.own.defections());
  return tried && both ? Move::D : Move::C;
}

}  // namespace folk
