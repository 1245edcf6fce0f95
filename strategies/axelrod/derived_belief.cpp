#include <folk/games/outcome.h>
#include <folk/strategies/axelrod/derived_belief.h>

#include <algorithm>

namespace folk {
namespace {

constexpr double discount = 0.75;
constexpr unsigned promoted_at = 3;      // answers in a row that make a rule
constexpr unsigned demoted_at = 4;       // violations in a row that end it
constexpr unsigned rejected_beyond = 3;  // violations of the default rules that end them all
constexpr unsigned depth_of_plan = 5;
constexpr std::array<double, 4> payoffs{3, 0, 5, 1};

}  // namespace

void DerivedBelief::record_answer(std::size_t outcome, Move theirs) {
  for (std::size_t i = 0; i < 4; ++i) {
    followed_[i].occurred.push_back(i == outcome);
    followed_[i].cooperated.push_back(i == outcome && theirs == Move::C);
  }
}

bool DerivedBelief::to_be_promoted(std::size_t outcome, Move theirs) const {
  const auto& [cooperated, occurred] = followed_[outcome];
  unsigned count = 0;
  for (std::size_t i = occurred.size(); i-- > 1;) {
    if (!occurred[i]) continue;
    if (cooperated[i] != (theirs == Move::C)) break;
    ++count;
  }
  return count >= promoted_at;
}

double DerivedBelief::frequency(std::size_t outcome) const {
  const auto& [cooperated, occurred] = followed_[outcome];
  double cooperations = 0;
  double occurrences = 0;
  double weight = 1;
  for (std::size_t i = occurred.size(); i-- > 0; weight *= discount) {
    if (cooperated[i]) cooperations += weight;
    if (occurred[i]) occurrences += weight;
  }
  return cooperations / occurrences;
}

void DerivedBelief::revise_rules(std::size_t outcome, Move theirs) {
  if (!current_[outcome] && to_be_promoted(outcome, theirs)) {
    current_[outcome] = theirs;
    violations_[outcome] = 0;
  }
  if (current_[outcome]) {
    violations_[outcome] = *current_[outcome] == theirs ? 0 : violations_[outcome] + 1;
    if (violations_[outcome] >= demoted_at) {
      for (std::size_t i = 0; i < 4; ++i)
        if (current_[i]) default_[i] = current_[i];
      current_ = {};
      violations_ = {};
      rejections_ = 0;
    }
  }
  const bool follows_current = current_[outcome] == theirs;
  const bool violates_default = default_[outcome] == other(theirs);
  if (violates_default) ++rejections_;
  if (rejections_ > rejected_beyond || (follows_current && violates_default)) {
    default_ = {};
    rejections_ = 0;
  }
}

void DerivedBelief::observe(Move own, Move theirs) {
  if (record_.rounds() > 0) {
    const std::size_t outcome = Outcome{record_.own.last(), record_.theirs.last()}.index();
    record_answer(outcome, theirs);
    revise_rules(outcome, theirs);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& rule = default_[i] ? default_[i] : current_[i];
      cooperation_[i] = rule ? (*rule == Move::C ? 1 : 0) : frequency(i);
    }
  }
  record_.add(own, theirs);
}

double DerivedBelief::value_of_move(Move own, std::size_t outcome, unsigned depth) const {
  const double p = cooperation_[outcome];
  return p * value(Outcome{own, Move::C}.index(), depth + 1) +
         (1 - p) * value(Outcome{own, Move::D}.index(), depth + 1);
}

double DerivedBelief::value(std::size_t outcome, unsigned depth) const {
  if (depth == depth_of_plan) return payoffs[outcome];
  return std::max(value_of_move(Move::C, outcome, depth), value_of_move(Move::D, outcome, depth)) + payoffs[outcome];
}

Move DerivedBelief::move() const {
  if (record_.rounds() == 0) return Move::C;
  const std::size_t outcome = Outcome{record_.own.last(), record_.theirs.last()}.index();
  const double now = payoffs[outcome];
  return value_of_move(Move::C, outcome, 0) + now >= value_of_move(Move::D, outcome, 0) + now ? Move::C : Move::D;
}

}  // namespace folk
