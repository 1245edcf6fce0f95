#pragma once
// A rule that puts every strategy in one of two halves, so that what a learner never meets is written down.

#include <folk/strategies/machine.h>

#include <cstdint>

namespace folk {

enum class Half { trained, held_out };

/// The rounds by which behaviours are told apart for their half.
inline constexpr unsigned half_rounds = 32;

/// A number for how a machine plays its first half_rounds rounds, whatever the other does, own moves being its own:
/// machines that play them alike have the same, on every machine and in every class. With key_0 = 0 the key of a
/// state is
///
///     key_r(s) = mix(P(C | s), key_{r-1} of the states after CC, CD, DC, DD)
///
/// where an outcome that cannot follow s counts as 0 and `mix` is Philox. Throws UsageError for a machine that reaches
/// more than 2^20 states in these rounds.
std::uint64_t behaviour_key(const Machine& machine);

/// The half of a machine: trained where its key is even. A strategy that plays as a trained one does is itself trained,
/// under whatever name, and so is one that differs only after half_rounds rounds. Throws as behaviour_key.
Half half_of(const Machine& machine);

}  // namespace folk
