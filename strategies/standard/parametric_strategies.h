#pragma once
// Strategies with parameters: the memory-one ones, zero-determinant ones among them.

#include <folk/games/rational.h>
#include <folk/strategies/registry.h>

#include <array>

namespace folk {

/// mem1 with these exact probabilities: of a first C, then of C after CC, CD, DC, DD.
Strategy memory_one_strategy(const Rational& first, const std::array<Rational, 4>& p);

void add_parametric(Registry& registry);

}  // namespace folk
