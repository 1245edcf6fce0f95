#include <folk/analysis/judgement/class_agreement.h>
#include <folk/analysis/replies/class_history.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace folk {
namespace {

/// ln(e^a + e^b).
double log_sum(double a, double b) {
  const double most = std::max(a, b);
  return std::isinf(most) ? most : most + std::log1p(std::exp(std::min(a, b) - most));
}

/// ln of p to the power of `count`, 0^0 being 1.
double log_power(double p, std::uint64_t count) { return count == 0 ? 0 : static_cast<double>(count) * std::log(p); }

}  // namespace

ClassAgreement::ClassAgreement(const MemoryClass& members, std::span<const RecordedMatch> matches, Seat seat)
    : members_(members),
      seen_(members.genes()) {
  for (const auto& match : matches) {
    ClassHistory history(members);
    for (const Outcome& round : match.rounds) {
      const Outcome seen = seen_from(seat, round);
      ++seen_[history.gene()][bit(seen.own)];
      history.observe(seen.own, seen.theirs);
    }
  }
}

unsigned ClassAgreement::asked() const {
  return static_cast<unsigned>(
      std::count_if(seen_.begin(), seen_.end(), [](const auto& seen) { return seen[0] + seen[1] > 0; }));
}

std::uint64_t ClassAgreement::fewest_slips() const {
  std::uint64_t slips = 0;
  for (const auto& [c, d] : seen_) slips += std::min(c, d);
  return slips;
}

Integer ClassAgreement::nearest() const {
  // A gene that was seen as often C as D is as near either way; so is one that was never asked for.
  const auto free = std::count_if(seen_.begin(), seen_.end(), [](const auto& seen) { return seen[0] == seen[1]; });
  return pow(Integer(2), static_cast<unsigned>(free));
}

std::string ClassAgreement::nearest_text() const {
  std::string text = fmt::format("mem{}{}_", members_.own_memory(), members_.their_memory());
  for (std::size_t gene = 0; gene < seen_.size(); ++gene) {
    const auto& [c, d] = seen_[gene];
    const char* moves = gene < members_.openings() ? "cd" : "CD";
    text += c == d ? '?' : moves[c > d ? 0 : 1];
  }
  return text;
}

double ClassAgreement::log_likelihood(double slip) const {
  double sum = 0;
  for (const auto& [c, d] : seen_) {
    if (c + d == 0) continue;
    const double if_c = log_power(1 - slip, c) + log_power(slip, d);
    const double if_d = log_power(1 - slip, d) + log_power(slip, c);
    sum += log_sum(if_c, if_d) - std::numbers::ln2;
  }
  return sum;
}

}  // namespace folk
