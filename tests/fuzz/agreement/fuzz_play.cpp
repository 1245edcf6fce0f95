// Three ways to play two deterministic machines: CycleFinder, play_deterministic and play_markov agree, on counts of
// finite:T exactly, else to 1e-10 of the criterion's weight.

#include <folk/analysis/play/cycle_table.h>
#include <folk/analysis/play/deterministic_play.h>
#include <folk/analysis/play/markov_play.h>

#include <cmath>

#include "fuzz.h"
#include "machine_bytes.h"

namespace {

using folk::Criterion;

Criterion criterion(folk::fuzz::Bytes& bytes) {
  const std::uint32_t kind = bytes.below(5);
  const std::uint32_t number = bytes.next();
  switch (kind) {
    case 0: return Criterion::finite(1 + number);
    case 1: return Criterion::finite(1 + number * 1'000'003ULL);
    case 2: return Criterion::mean();
    case 3: return Criterion::discounted(folk::Rational(1 + number, 257));
    default: return Criterion::ending(folk::Rational(1, 1 + number * number));
  }
}

bool agree(const folk::OutcomeWeights& one, const folk::OutcomeWeights& other, double tolerance) {
  for (std::size_t o = 0; o < 4; ++o)
    if (!(std::abs(one[o] - other[o]) <= tolerance)) return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  folk::fuzz::Bytes bytes(data, size);
  const Criterion how = criterion(bytes);
  const folk::Automaton first = folk::fuzz::machine(bytes, 12);
  const folk::Automaton second = folk::fuzz::machine(bytes, 12);
  // Two pairs with one finder, as in a tournament: the marks of the first must not count for the second.
  folk::CycleFinder finder(1 + bytes.below(2) * (folk::CycleFinder::last_epoch - 2));
  const folk::CycleTable one(first);
  const folk::CycleTable other(second);
  const auto turned = finder.play(other, one, how);
  const auto found = finder.play(one, other, how);
  folk::fuzz::require(exchanged(turned).weights == found.weights);

  const double tolerance = how.is_finite() ? 0 : 1e-10 * how.total_weight();
  const auto general = folk::play_deterministic(first, second, how);
  folk::fuzz::require(general.method == folk::Method::cycle);
  folk::fuzz::require(agree(found.weights, general.weights, tolerance));
  const auto chain = folk::play_markov(first, second, 0, how);
  folk::fuzz::require(chain && agree(found.weights, chain->weights, tolerance));
  return 0;
}
