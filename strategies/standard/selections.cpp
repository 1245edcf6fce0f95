#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/names.h>
#include <folk/strategies/standard/filters.h>
#include <folk/strategies/standard/selections.h>

#include <limits>
#include <utility>

namespace folk {
namespace {

using Reader = std::function<Pool(std::string_view spec)>;

Pool read_sample(std::string_view arguments, const Reader& read) {
  LastArgument parts = split_last_argument(arguments);
  std::uint64_t seed = 1;
  if (const auto given = parts.last ? value_of_option(*parts.last, "seed") : std::nullopt) {
    seed = parse_whole_number(*given, "sample seed", 0, std::numeric_limits<std::uint64_t>::max());
    parts = split_last_argument(parts.spec);
  }
  if (!parts.last)
    throw UsageError(
        fmt::format("sample({}): how many? write sample(SPEC;40), or sample(SPEC;40;seed=7)", excerpt(arguments)));
  const auto count = parse_whole_number(*parts.last, "sample(SPEC;N;seed=S) N", 1, Family::most_listed);
  return {sample_of(read(parts.spec), count, seed), {}};
}

Pool read_half(std::string_view arguments, const Reader& read) {
  const auto [spec, last] = split_last_argument(arguments);
  const std::string which = name_key(last.value_or(""));
  if (which != "trained" && which != "heldout")
    throw UsageError(
        fmt::format("half({}): which? write half(SPEC;trained) or half(SPEC;held_out)", excerpt(arguments)));
  return half_of(read(spec), which == "trained" ? Half::trained : Half::held_out);
}

Pool read_where(std::string_view arguments, const Reader& read) {
  const auto [spec, conditions] = split_last_argument(arguments);
  if (!conditions)
    throw UsageError(fmt::format("where({}): which? write where(SPEC;nice,memory<=2,finite)", excerpt(arguments)));
  auto met = those_that_meet(*conditions, list_of(read(spec)));
  if (met.empty()) throw UsageError(fmt::format("where({}): none is so", excerpt(arguments)));
  return {std::move(met), {}};
}

}  // namespace

void add_selections(Registry& registry) {
  registry.add_selection({"sample(SPEC;N;seed=S)",
                          {},
                          "N different strategies of SPEC, drawn; S is 1 if not given",
                          "docs/ipd-tournament.md"},
                         read_sample);
  registry.add_selection({"half(SPEC;trained)",
                          {},
                          "the strategies of SPEC in that half of all; half(SPEC;held_out): "
                          "the others",
                          "docs/ipd-tournament.md"},
                         read_half);
  registry.add_selection({"where(SPEC;CONDITIONS)",
                          {},
                          "the strategies of SPEC that are so: machine, finite, deterministic, nice, memory<=2, "
                          "states<=4; 'not' turns one round",
                          "docs/ipd-strategies.md"},
                         read_where);
}

}  // namespace folk
