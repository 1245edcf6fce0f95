#include <folk/analysis/replies/class_posterior.h>

#include <cmath>

namespace folk {

ClassPosterior::ClassPosterior(const MemoryClass& members)
    : history_(members),
      lead_(members.genes(), 0) {}

double ClassPosterior::cooperation(double slip) const {
  const int lead = lead_[history_.gene()];
  if (lead == 0) return 0.5;
  // P(gene is C | lead) = 1 / (1 + (slip / (1 - slip))^lead), and 0^-1 is infinite.
  const double gene_is_c = 1 / (1 + std::pow(slip / (1 - slip), lead));
  return slip + (1 - 2 * slip) * gene_is_c;
}

void ClassPosterior::observe(Move own, Move theirs) {
  auto& lead = lead_[history_.gene()];
  constexpr std::int16_t most = 10'000;  // more changes nothing
  if (theirs == Move::C && lead < most) ++lead;
  if (theirs == Move::D && lead > -most) --lead;
  history_.observe(theirs, own);
}

}  // namespace folk
