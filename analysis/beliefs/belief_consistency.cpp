#include <folk/analysis/beliefs/belief_consistency.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace folk {
namespace {

std::optional<double> share(double sum, std::uint64_t count) {
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

std::size_t bin_of(double belief) { return std::min<std::size_t>(static_cast<std::size_t>(belief * 10), 9); }

std::vector<std::uint64_t> united(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  std::vector<std::uint64_t> both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

}  // namespace

std::optional<double> CalibrationBin::mean_belief() const { return share(belief_sum, count); }

std::optional<double> CalibrationBin::frequency() const { return share(static_cast<double>(cooperations), count); }

std::optional<double> BeliefConsistency::mean_distance() const { return share(distance_sum, rounds); }

std::optional<double> BeliefConsistency::accuracy() const { return share(static_cast<double>(right), rounds); }

std::optional<double> BeliefConsistency::log_loss() const { return share(log_loss_sum, rounds); }

std::optional<double> BeliefConsistency::brier() const { return share(brier_sum, rounds); }

std::optional<std::uint64_t> BeliefConsistency::settled_from() const {
  if (rounds == 0 || last_wrong) return std::nullopt;
  return wrong_rounds.empty() ? first_round : wrong_rounds.back() + 1;
}

void BeliefConsistency::add(const BeliefMatch& match) {
  BeliefConsistency one;
  one.matches = 1;
  for (std::size_t t = 0; t < match.size(); ++t) {
    const BeliefRound& round = match[t];
    if (!round.belief) continue;
    const double belief = *round.belief;
    if (!(belief >= 0 && belief <= 1)) throw std::logic_error("a belief outside [0, 1]");
    const bool cooperated = round.theirs == Move::C;
    const double distance = std::abs(belief - round.truth);
    const double given = cooperated ? belief : 1 - belief;
    ++one.rounds;
    if (one.first_round == 0) one.first_round = t + 1;
    one.largest_distance = std::max(one.largest_distance, distance);
    one.distance_sum += distance;
    one.log_loss_sum -= std::log(given);
    if (given == 0) ++one.surprises;
    one.brier_sum += (1 - given) * (1 - given);
    auto& bin = one.bins[bin_of(belief)];
    ++bin.count;
    bin.belief_sum += belief;
    if (cooperated) ++bin.cooperations;
    one.last_wrong = likelier_move(belief) != round.theirs;
    if (one.last_wrong)
      one.wrong_rounds.push_back(t + 1);
    else
      ++one.right;
  }
  *this += one;
}

BeliefConsistency& BeliefConsistency::operator+=(const BeliefConsistency& more) {
  matches += more.matches;
  rounds += more.rounds;
  largest_distance = std::max(largest_distance, more.largest_distance);
  distance_sum += more.distance_sum;
  right += more.right;
  log_loss_sum += more.log_loss_sum;
  surprises += more.surprises;
  brier_sum += more.brier_sum;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].count += more.bins[i].count;
    bins[i].belief_sum += more.bins[i].belief_sum;
    bins[i].cooperations += more.bins[i].cooperations;
  }
  wrong_rounds = united(wrong_rounds, more.wrong_rounds);
  if (first_round == 0 || (more.first_round != 0 && more.first_round < first_round)) first_round = more.first_round;
  last_wrong = last_wrong || more.last_wrong;
  return *this;
}

BeliefConsistency belief_consistency(const BeliefRecord& record) {
  BeliefConsistency consistency;
  for (const auto& match : record.matches) consistency.add(match);
  return consistency;
}

}  // namespace folk
