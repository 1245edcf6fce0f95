#pragma once
// Random values for property tests of the games.

#include <folk/games/integer.h>
#include <folk/games/rational.h>
#include <folk/games/stage_game.h>
#include <rapidcheck.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace rc {

/// Around the ends of what fits 32 and 64 bits, near 0, and of up to 256 bits.
template <>
struct Arbitrary<folk::Integer> {
  static Gen<folk::Integer> arbitrary() {
    const auto near = [](const folk::Integer& place) {
      return gen::map(gen::inRange(-3, 4), [place](int offset) { return place + offset; });
    };
    const folk::Integer word = folk::Integer(1) << 63;
    const folk::Integer half = folk::Integer(1) << 32;
    const auto word_wide =
        gen::map(gen::arbitrary<std::int64_t>(), [](std::int64_t value) { return folk::Integer(value); });
    const auto long_one = gen::apply(
        [](const std::vector<std::int64_t>& words) {
          folk::Integer sum;
          for (const std::int64_t next : words) sum = (sum << 64) + next;
          return sum;
        },
        gen::resize(4, gen::container<std::vector<std::int64_t>>(gen::inRange(
                           std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()))));
    return gen::oneOf(near(0), near(half), near(-half), near(word), near(-word), word_wide, long_one);
  }
};

template <>
struct Arbitrary<folk::Rational> {
  static Gen<folk::Rational> arbitrary() {
    const auto above = gen::arbitrary<std::int64_t>();
    // Half of them end as decimals.
    const auto below = gen::oneOf(gen::element<std::int64_t>(1, 2, 4, 5, 10, 100, 1'000'000, 9'765'625),
                                  gen::inRange<std::int64_t>(1, 1'000'000'000));
    return gen::apply([](std::int64_t a, std::int64_t b) { return folk::Rational(a) / folk::Rational(b); }, above,
                      below);
  }
};

template <>
struct Arbitrary<folk::StageGame> {
  static Gen<folk::StageGame> arbitrary() {
    return gen::exec([] {
      const auto names = [](const char* what) {
        return *gen::unique<std::vector<std::string>>(*gen::inRange<std::size_t>(1, 5), gen::nonEmpty<std::string>())
                    .as(what);
      };
      const auto rows = names("rows");
      const auto columns = names("columns");
      const auto payoffs = *gen::container<std::vector<std::array<folk::Rational, 2>>>(
          rows.size() * columns.size(), gen::arbitrary<std::array<folk::Rational, 2>>());
      return folk::StageGame(*gen::arbitrary<std::string>(),
                             {*gen::arbitrary<std::string>(), *gen::arbitrary<std::string>()}, {rows, columns}, payoffs,
                             *gen::arbitrary<std::string>());
    });
  }
};

}  // namespace rc
