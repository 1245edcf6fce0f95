#pragma once
// Which strategies of a list have what can be computed of them: where(SPEC; nice, memory<=2, finite).

#include <folk/strategies/strategy.h>

#include <string_view>
#include <vector>

namespace folk {

/// The strategies that meet all conditions of a comma list, in their order. A condition is a word - machine (not only
/// played), finite, deterministic, nice - or a number with a bound, memory<=2 or states>4 (<, <=, =, >=, >), each as
/// facts.h has them; "not" before it turns it round. What cannot be known of a strategy meets neither a condition nor
/// its opposite: states and memory of a player without a machine, which is nice if it has been for
/// `rounds_of_niceness`, and all of a program, which is not started. Throws UsageError for what is no condition.
std::vector<Strategy> those_that_meet(std::string_view conditions, std::vector<Strategy> strategies);

inline constexpr unsigned rounds_of_niceness = 100;

}  // namespace folk
