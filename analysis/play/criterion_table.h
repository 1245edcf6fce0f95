#pragma once
// A machine as the table that a criterion needs.

#include <folk/analysis/play/criterion_table.h>
#include <folk/games/criterion.h>
#include <folk/strategies/automaton.h>

namespace folk {

/// A machine as the table that a criterion needs: for finite:T what it reaches within T rounds, else all its states, or
/// those within the horizon where there is no end to them.
/// Throws UsageError when the machine is infinite, the criterion has no end and no horizon is given (for mean: always).
Automaton table_for(const Machine& machine, const Criterion& criterion, Sense sense, unsigned horizon);

}  // namespace folk
