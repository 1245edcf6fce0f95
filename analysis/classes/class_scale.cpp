#include <folk/analysis/classes/class_scale.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <cmath>

namespace folk {
namespace {

/// The largest sum that is kept.
constexpr double most = 0x1p62;

}  // namespace

ClassScale class_scale(const MemoryClass& members, const Payoffs& payoffs, const Criterion& criterion, double weight) {
  ClassScale scale;
  scale.payoffs = whole_payoffs(payoffs);
  const double largest = criterion.total_weight() * scale.payoffs.largest;
  if (criterion.kind() == Criterion::Kind::mean && members.openings() <= 2) {
    scale.common = 720'720;  // the least common multiple of 1 to 16, the joint states of two memories of two rounds
  } else if (!criterion.is_finite()) {
    scale.exact = false;
  }
  const double room = most / (weight * largest * static_cast<double>(scale.common));
  if (!(room >= 1))
    throw UsageError(
        fmt::format("the members of {} would score too much under {} to count exactly: play fewer rounds "
                    "or give payoffs of fewer digits",
                    members.name(), criterion.to_string()));
  const double fixed = scale.exact ? static_cast<double>(scale.common) : std::exp2(std::floor(std::log2(room)));
  scale.score_unit = scale.payoffs.scale * fixed;
  scale.cooperation_unit = fixed;
  scale.tolerance = scale.exact ? 0 : score_rounding * largest;
  return scale;
}

}  // namespace folk
