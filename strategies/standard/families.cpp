#include <fmt/format.h>
#include <folk/games/rational.h>
#include <folk/strategies/standard/families.h>
#include <folk/strategies/standard/memory_class.h>
#include <folk/strategies/standard/named_machine.h>
#include <folk/strategies/standard/parametric_strategies.h>
#include <folk/strategies/standard/periodic_machine.h>

#include <array>
#include <utility>

namespace folk {
namespace {

constexpr const char* family_reference = "Mathieu & Delahaye, JASSS 20(4) 12, 2017";

unsigned small_whole(const std::string& text, std::string_view what, unsigned low, unsigned high) {
  return static_cast<unsigned>(parse_whole_number(text, what, low, high));
}

Family memory_family(std::string_view arguments) {
  const MemoryClass members = MemoryClass::of_arguments(arguments);
  const std::string name = members.name();
  return {name, members.size(),
          [members](const Integer& number) {
            auto machine = members.member(number);
            std::string genotype = machine.name();
            return named_machine(std::move(genotype), std::move(machine));
          },
          fmt::format("{} has {} members, more than the {} that can be listed: it is ranked as a whole by "
                      "ipd-tournament --strategies '{}' alone, scores entrants by --class '{}', and lends some of its "
                      "members by 'sample({};40)'",
                      name, members.size_text(), Family::most_listed, name, name, name)};
}

/// Word number 0, 1, ...: "c", "d", "cc", "cd", ...
Strategy word_of_number(std::uint64_t number) {
  unsigned length = 1;
  for (; number >= std::uint64_t{1} << length; ++length) number -= std::uint64_t{1} << length;
  std::string word;
  for (unsigned i = length; i-- > 0;) word += ((number >> i) & 1U) != 0 ? 'd' : 'c';
  return named_machine("per_" + word, PeriodicMachine(word));
}

/// Number 0, 1, ... of those that open with C, then of those that open with D.
Strategy probabilities_of_number(std::uint64_t number, unsigned steps) {
  const std::uint64_t values = steps + 1;
  const std::uint64_t tables = values * values * values * values;
  const bool opens_with_c = number < tables;
  std::array<Rational, 4> p{};
  for (std::size_t i = 4; i-- > 0; number /= values) p[i] = Rational(number % values, steps);
  return memory_one_strategy(opens_with_c ? 1 : 0, p);
}

std::uint64_t small_number(const Integer& number) { return static_cast<std::uint64_t>(number.word()); }

}  // namespace

void add_families(Registry& registry) {
  registry.add_family({"memory(X,Y)", {}, "all genotypes of own last X and their last Y moves", family_reference},
                      memory_family);
  registry.add_family({"periodic(n)", {}, "all words of up to n moves, for ever", family_reference},
                      [](std::string_view text) {
                        const unsigned longest = small_whole(std::string(text), "periodic(n) n", 1, 13);
                        return Family{fmt::format("periodic({})", longest), (Integer(2) << longest) - 2,
                                      [](const Integer& number) { return word_of_number(small_number(number)); }};
                      });
  registry.add_family(
      {"proba(K)", {}, "all mem1 with first move c or d and probabilities 0, 1/K, ..., 1", family_reference},
      [](std::string_view text) {
        const unsigned steps = small_whole(std::string(text), "proba(K) K", 1, 9);
        return Family{fmt::format("proba({})", steps), 2 * pow(Integer(steps + 1), 4),
                      [steps](const Integer& number) { return probabilities_of_number(small_number(number), steps); }};
      });
}

}  // namespace folk
