#include <folk/strategies/axelrod/second_tournament.h>

#include <algorithm>
#include <cmath>

namespace folk {

// ---- Borufsen ----

void Borufsen::judge() {
  const unsigned cooperations = answers_[0] + answers_[1];
  // Too few, or about as many as a coin gives and not mainly in answer to C.
  defects_ = cooperations < 3 || (cooperations >= 8 && cooperations <= 17 && 10 * answers_[0] < 7 * cooperations);
  answers_ = {};
  if (!defects_) return;
  mutual_defections_ = echoes_ = 0;
  forgives_next_ = false;
}

Move Borufsen::softened(Move move) {
  if (move == Move::C || !forgives_next_) return move;
  forgives_next_ = false;
  return Move::C;
}

Move Borufsen::decide(Move own, Move theirs, Move own_before, Move theirs_before) {
  mutual_defections_ = own == Move::D && theirs == Move::D ? mutual_defections_ + 1 : 0;
  if (mutual_defections_ >= 3) {
    mutual_defections_ = echoes_ = 0;
    return Move::C;
  }
  echoes_ = own != theirs && own == theirs_before && theirs == own_before ? echoes_ + 1 : 0;
  if (echoes_ >= 3) {
    mutual_defections_ = echoes_ = 0;
    forgives_next_ = true;
  }
  return softened(theirs);
}

void Borufsen::observe(Move own, Move theirs) {
  record_.add(own, theirs);
  const std::size_t round = record_.rounds() + 1;
  if (round > 2 && theirs == Move::C) ++answers_[bit(record_.own.last_but_one())];
  if (round > 2 && round % 25 == 2) {
    const bool defected = defects_;
    judge();
    if (defected && !defects_) {
      move_ = Move::D;
      return;
    }
  }
  move_ = defects_ ? Move::D : decide(own, theirs, record_.own.last_but_one(), record_.theirs.last_but_one());
}

// ---- Graaskamp & Katzen ----

void GraaskampKatzen::observe(Move own, Move theirs) {
  score_ += payoffs_[2 * bit(own) + bit(theirs)];
  last_ = theirs;
  if (rounds_ == 100) return;
  ++rounds_;
  const bool milestone = rounds_ == 100 || (rounds_ % 10 == 0 && rounds_ <= 50);
  if (milestone && score_ < 3.0 * rounds_ - 7) defects_ = true;
}

// ---- Hufford ----

Move Hufford::by_agreement(Move theirs) const {
  const auto round = static_cast<std::int64_t>(record_.rounds()) + 1;
  const unsigned lately = 4 - disagreements_.defections();
  if (10 * agreements_ > 9 * round && lately == 4) return Move::C;
  return 8 * agreements_ >= 5 * round && lately >= 2 ? theirs : Move::D;
}

void Hufford::observe(Move own, Move theirs) {
  record_.add(own, theirs);
  const auto round = static_cast<std::int64_t>(record_.rounds()) + 1;
  const bool agreed = record_.own.last_but_one() == theirs;
  if (agreed) ++agreements_;
  disagreements_.add(agreed ? Move::C : Move::D);
  if (last_test_ == 0) {
    streak_ = theirs == Move::C ? streak_ + 1 : 0;
    if (streak_ >= streak_needed_) {
      last_test_ = round;
      if (streak_ == streak_needed_) {
        move_ = Move::D;
        return;
      }
    }
  } else if (round == last_test_ + 2) {
    last_test_ = 0;
    ++(theirs == Move::C ? cooperated_after_test_ : defected_after_test_);
    streak_needed_ = 20 * defected_after_test_ / cooperated_after_test_ + 1;
    streak_ = 0;
    move_ = Move::C;
    return;
  }
  move_ = by_agreement(theirs);
}

// ---- Rowsam ----

unsigned Rowsam::distrust() const {
  const double mean = score_ / static_cast<double>(rounds_ + 1);
  return mean < 1 ? 5 : mean < 1.5 ? 3 : mean < 2 ? 2 : mean < 2.5 ? 1 : 0;
}

void Rowsam::observe(Move own, Move theirs) {
  if (defects_) return;
  ++rounds_;
  score_ += payoffs_[2 * bit(own) + bit(theirs)];
  const std::int64_t round = rounds_ + 1;
  move_ = Move::C;
  if (cycle_left_ > 0) {
    --cycle_left_;
    move_ = cycle_left_ == 0 ? Move::D : Move::C;
    return;
  }
  if (round % 18 == 0 && distrust_ >= 3) --distrust_;
  if (round % 6 != 0) return;
  const unsigned more = distrust();
  if (more == 0) return;
  distrust_ += more;
  move_ = Move::D;
  if (distrust_ >= 7) {
    defects_ = true;
  } else {
    cycle_left_ = 2;
  }
}

// ---- Tideman & Chieruzzi ----

void SecondTidemanChieruzzi::observe(Move own, Move theirs) {
  ++rounds_;
  defections_ += bit(theirs);
  lead_ += payoffs_[2 * bit(own) + bit(theirs)] - payoffs_[2 * bit(theirs) + bit(own)];
  const std::int64_t round = rounds_ + 1;
  const bool new_defection = before_ == Move::C && theirs == Move::D;
  before_ = theirs;
  move_ = Move::C;
  if (starting_) {
    starting_ = false;
    last_start_ = round;
    lead_ = bound_ = raise_ = 0;
    return;
  }
  if (new_defection) {
    bound_ += raise_;
    raise_ += 5;
  }
  if (lead_ >= bound_) return;
  const auto rounds = static_cast<double>(rounds_);
  const double deviation = std::abs(static_cast<double>(defections_) - rounds / 2);
  starting_ = !new_defection && round - last_start_ >= 10 && deviation >= 3 * std::sqrt(rounds) / 2;
  if (!starting_) move_ = Move::D;
}

// ---- Weiner ----

void Weiner::observe(Move, Move theirs) {
  if (rounds_ > 0) before_last_.add(last_);
  ++rounds_;
  last_ = theirs;
  move_ = theirs;
  if (may_forgive_) {
    may_forgive_ = false;
    run_ = 0;
    if (grudge_ < rounds_ + 1 && theirs == Move::D) {
      grudge_ += 20;
      move_ = Move::C;
    }
  } else if (theirs == Move::D) {
    ++run_;
  } else {
    may_forgive_ = run_ % 2 == 1;
    run_ = 0;
  }
  if (before_last_.defections() >= 5) move_ = Move::D;
}

// ---- White ----

Move White::move() const {
  const std::size_t round = theirs_.size() + 1;
  if (round <= 10 || theirs_.last() == Move::C) return Move::C;
  const auto whole = static_cast<std::size_t>(std::log(static_cast<double>(round)));
  return whole * theirs_.defections() >= round ? Move::D : Move::C;
}

// ---- Yamachi ----

Move Yamachi::move() const {
  const std::size_t round = theirs_.size() + 1;
  const double defections = (static_cast<double>(theirs_.defections()) + 0.5) / static_cast<double>(round);
  return round > 40 && defections > 0.45 && defections < 0.55 ? Move::D : predicted_;
}

void Yamachi::observe(Move, Move theirs) {
  predictions_.add(predicted_);
  theirs_.add(theirs);
  const std::size_t n = theirs_.size();
  const auto place = [](Move before, Move own, Move then) { return 4 * bit(before) + 2 * bit(own) + bit(then); };
  const Move before = theirs_.last_but_one();
  if (n >= 2) {
    const Move earlier = n >= 3 ? theirs_[n - 3] : Move::C;
    ++counts_[place(earlier, predictions_.last_but_one(), before)];
  }
  const Move own = predictions_.last();
  predicted_ = counts_[place(before, own, Move::C)] >= counts_[place(before, own, Move::D)] ? Move::C : Move::D;
}

}  // namespace folk
