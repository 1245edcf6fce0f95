#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/random.h>
#include <folk/strategies/names.h>
#include <folk/strategies/pool.h>

#include <map>
#include <set>
#include <utility>

namespace folk {
namespace {

/// The role of who draws rosters, after those of matches and populations (games/match_key.h, evolution_seed.h): the
/// number is part of what a seed means.
constexpr std::uint64_t drawing_role = 6;

/// Uniform below `size`, by as many words as it takes; what would favour small numbers is drawn again.
Integer uniform_below(const Integer& size, RandomStream& random) {
  Integer values = 1;
  unsigned words = 0;
  for (; values < size; ++words) values <<= 64;
  const Integer even_share = values - values % size;
  for (;;) {
    Integer number = 0;
    for (unsigned i = 0; i < words; ++i) number = (number << 64) + Integer(random());
    if (number < even_share) return number % size;
  }
}

Half half_of_strategy(const Strategy& strategy) {
  if (!strategy.machine)
    throw UsageError(fmt::format("half: '{}' is no machine, and how it plays is not known before it has played",
                                 excerpt(strategy.name)));
  return half_of(*strategy.machine);
}

bool is_in(const Family& family, const Strategy& member) {
  return !family.half || half_of_strategy(member) == *family.half;
}

/// Where a strategy stands in a pool: the list is part 0, each family a part of its own.
struct Place {
  std::size_t part = 0;
  Integer number;

  auto operator<=>(const Place&) const = default;
};

/// The place of a number among all of the pool.
Place place_of(const Pool& pool, Integer number) {
  const Integer listed = pool.listed.size();
  if (number < listed) return {0, std::move(number)};
  number -= listed;
  std::size_t part = 1;
  for (const auto& family : pool.unlisted) {
    if (number < family.size) break;
    number -= family.size;
    ++part;
  }
  return {part, std::move(number)};
}

void refuse_count(const Pool& pool, std::uint64_t count) {
  if (count == 0 || count > Family::most_listed)
    throw UsageError(fmt::format("sample: {} strategies, expected 1 to {}", count, Family::most_listed));
  if (pool.unlisted.empty() && count > pool.listed.size())
    throw UsageError(fmt::format("sample: {} strategies of {}: there are not so many to draw different ones", count,
                                 pool.listed.size()));
}

/// Draws in a row that bring no new strategy, before there is taken to be none: a half of a family too large to be
/// counted is not counted.
constexpr unsigned most_in_vain = 10'000;

/// The strategy that is drawn with this place; nothing where it is not in the pool's half, and for a family's member
/// that is `listed` too, which is drawn as the listed one.
std::optional<Strategy> strategy_at(const Pool& pool, const Place& place, const std::set<std::string>& listed) {
  if (place.part == 0) return pool.listed[static_cast<std::size_t>(place.number.word())];
  const Family& family = pool.unlisted[place.part - 1];
  Strategy member = family.member(place.number);
  if (listed.contains(name_identity(member.name)) || !is_in(family, member)) return std::nullopt;
  return member;
}

}  // namespace

Pool pool_of(Family family) {
  Pool pool;
  if (family.size > Integer(Family::most_listed)) {
    pool.unlisted.push_back(std::move(family));
    return pool;
  }
  for (Integer number = 0; number < family.size; number += 1) {
    Strategy member = family.member(number);
    if (is_in(family, member)) pool.listed.push_back(std::move(member));
  }
  return pool;
}

std::vector<Strategy> list_of(Pool pool) {
  if (!pool.unlisted.empty()) throw UsageError(pool.unlisted.front().refusal);
  return std::move(pool.listed);
}

Pool half_of(Pool pool, Half half) {
  std::erase_if(pool.listed, [half](const Strategy& strategy) { return half_of_strategy(strategy) != half; });
  std::erase_if(pool.unlisted, [half](const Family& family) { return family.half && *family.half != half; });
  for (auto& family : pool.unlisted) {
    family.half = half;
    const std::string_view word = half == Half::trained ? "trained" : "held_out";
    family.refusal = fmt::format(
        "half({};{}) has more members than the {} that can be listed: draw some of them, as in "
        "'sample(half({};{});40)'",
        family.name, word, Family::most_listed, family.name, word);
  }
  if (pool.listed.empty() && pool.unlisted.empty())
    throw UsageError("half: none of these strategies is in that half: take the other one, or more strategies");
  return pool;
}

std::vector<Strategy> sample_of(const Pool& pool, std::uint64_t count, std::uint64_t seed) {
  refuse_count(pool, count);
  Integer size = pool.listed.size();
  for (const auto& family : pool.unlisted) size += family.size;
  std::set<std::string> listed;
  if (!pool.unlisted.empty())
    for (const auto& strategy : pool.listed) listed.insert(name_identity(strategy.name));

  RandomStream random({seed, 0, 0, drawing_role});
  std::map<Place, Strategy> drawn;
  for (unsigned in_vain = 0; drawn.size() < count; ++in_vain) {
    if (in_vain == most_in_vain)
      throw UsageError(
          fmt::format("sample: {} strategies, but after {} there seem to be no others", count, drawn.size()));
    Place place = place_of(pool, uniform_below(size, random));
    if (drawn.contains(place)) continue;
    auto strategy = strategy_at(pool, place, listed);
    if (!strategy) continue;
    drawn.emplace(std::move(place), *std::move(strategy));
    in_vain = 0;
  }
  std::vector<Strategy> sample;
  for (auto& [place, strategy] : drawn) sample.push_back(std::move(strategy));
  return sample;
}

}  // namespace folk
