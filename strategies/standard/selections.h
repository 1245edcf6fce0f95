#pragma once
// The items of a roster that take some of the strategies of another SPEC.

#include <folk/strategies/registry.h>

namespace folk {

/// Makes a registry know
///   sample(SPEC;N;seed=S)  N different strategies of SPEC, drawn by sample_of; S is 1 where it is not given
///   half(SPEC;trained)     those in the half that may be trained on, by half_of; half(SPEC;held_out) the others
///   where(SPEC;CONDITIONS) those that meet all of them, by those_that_meet
/// SPEC is whatever a roster may hold, these three included, and classes too large to be listed: a sample of one draws
/// genotypes, a half of one can be sampled; conditions need
/// a list.
void add_selections(Registry& registry);

}  // namespace folk
