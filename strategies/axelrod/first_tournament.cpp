#include <folk/strategies/axelrod/cycles.h>
#include <folk/strategies/axelrod/first_tournament.h>

#include <cmath>

namespace folk {
namespace {

/// The 95th percentile of chi squared with one degree of freedom.
constexpr double chi_squared_bound = 3.841458820694124;

}  // namespace

bool looks_random(std::size_t cooperations, std::size_t defections) {
  const double lead = static_cast<double>(cooperations) - static_cast<double>(defections);
  return lead * lead <= chi_squared_bound * static_cast<double>(cooperations + defections);
}

void SteinRapoport::observe(Move, Move theirs) {
  ++rounds_;
  defections_ += bit(theirs);
  last_ = theirs;
  const std::uint64_t round = rounds_ + 1;
  if (round % 15 == 0) random_ = looks_random(rounds_ - defections_, defections_);
}

bool TidemanChieruzzi::may_start_afresh(Move theirs) const {
  const std::uint64_t round = rounds_ + 1;
  if (last_start_ != 0 && round - last_start_ < 20) return false;
  if (lead_ < 10 || theirs == Move::D) return false;
  // Three standard deviations from what a fair coin gives; D are counted from the last fresh start, rounds are not.
  const auto rounds = static_cast<double>(rounds_);
  const double deviation = std::abs(static_cast<double>(defections_) - rounds / 2);
  return deviation >= 3 * std::sqrt(rounds) / 2;
}

void TidemanChieruzzi::observe(Move own, Move theirs) {
  ++rounds_;
  defections_ += bit(theirs);
  lead_ += payoffs_[2 * bit(own) + bit(theirs)] - payoffs_[2 * bit(theirs) + bit(own)];
  move_ = Move::C;
  if (starting_) {
    starting_ = false;
  } else if (may_start_afresh(theirs)) {
    last_start_ = rounds_ + 1;
    starting_ = true;
    defections_ = length_ = left_ = 0;
  } else if (left_ > 0) {
    --left_;
    move_ = Move::D;
  } else if (theirs == Move::D) {
    left_ = length_++;
    move_ = Move::D;
  }
}

std::uint64_t Graaskamp::rounds_after_next_defection() {
  return record_.rounds() + 5 + static_cast<std::uint64_t>(11 * random_numbers_.uniform());
}

Move Graaskamp::move() {
  const std::size_t rounds = record_.rounds();
  if (rounds == 0) return Move::C;
  if (rounds < 56) return rounds == 50 ? Move::D : record_.theirs.last();
  random_ = random_ || looks_random(record_.theirs.cooperations(), record_.theirs.defections());
  if (random_) return Move::D;
  if (copies_ || equals_) return record_.theirs.last();
  if (next_defection_ == 0) next_defection_ = rounds_after_next_defection();
  if (rounds != next_defection_) return Move::C;
  next_defection_ = rounds_after_next_defection();
  return Move::D;
}

void Graaskamp::observe(Move own, Move theirs) {
  if (own != theirs) equals_ = false;
  if (record_.rounds() > 0 && theirs != record_.own.last()) copies_ = false;
  record_.add(own, theirs);
}

Move Calculator::move() {
  const std::size_t rounds = theirs_.size();
  if (rounds >= 20) return cycles_ ? Move::D : theirs_.last();
  if (rounds > 0 && theirs_.last() == Move::D) return Move::D;
  return rounds == 0 || random_numbers_.chance(0.9) ? Move::C : Move::D;
}

void Calculator::observe(Move, Move theirs) {
  theirs_.add(theirs);
  if (theirs_.size() == 20) cycles_ = cycle_length(theirs_, 0, 1) > 0;
}

}  // namespace folk
