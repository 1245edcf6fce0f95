#include <folk/analysis/replies/class_posterior.h>

#include <cmath>

namespace folk {

ClassPosterior::ClassPosterior(const MemoryClass& members)
    : own_memory_(members.own_memory()),
      their_memory_(members.their_memory()),
      openings_(members.openings()),
      lead_(members.genes(), 0) {}

std::size_t ClassPosterior::gene() const {
  if (rounds_ < openings_) return rounds_;
  const auto last = [](std::uint32_t moves, unsigned memory) { return moves & ((1U << memory) - 1); };
  return openings_ + (last(members_, own_memory_) << their_memory_ | last(others_, their_memory_));
}

double ClassPosterior::cooperation(double slip) const {
  const int lead = lead_[gene()];
  if (lead == 0) return 0.5;
  // P(gene is C | lead) = 1 / (1 + (slip / (1 - slip))^lead), and 0^-1 is infinite.
  const double gene_is_c = 1 / (1 + std::pow(slip / (1 - slip), lead));
  return slip + (1 - 2 * slip) * gene_is_c;
}

void ClassPosterior::observe(Move own, Move theirs) {
  auto& lead = lead_[gene()];
  constexpr std::int16_t most = 10'000;  // more changes nothing
  if (theirs == Move::C && lead < most) ++lead;
  if (theirs == Move::D && lead > -most) --lead;
  members_ = members_ << 1U | static_cast<std::uint32_t>(bit(theirs));
  others_ = others_ << 1U | static_cast<std::uint32_t>(bit(own));
  if (rounds_ < openings_) ++rounds_;
}

}  // namespace folk
