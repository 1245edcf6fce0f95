#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/facts.h>
#include <folk/strategies/names.h>
#include <folk/strategies/standard/filters.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace folk {
namespace {

/// A strategy with its facts, which are computed when they are first asked for.
class Candidate {
public:
  explicit Candidate(const Strategy& strategy)
      : strategy_(strategy) {}

  std::optional<bool> machine() const { return strategy_.machine != nullptr; }

  std::optional<bool> finite() const {
    if (!strategy_.machine) return std::nullopt;
    return strategy_.machine->finite();
  }

  std::optional<bool> deterministic() {
    if (!strategy_.machine) return strategy_.deterministic;
    return facts().deterministic;
  }

  std::optional<bool> nice() const {
    if (strategy_.machine) return niceness_of(*strategy_.machine).nice;
    if (!strategy_.deterministic) return std::nullopt;
    const auto player = strategy_.new_player();
    // A program, of which there is no second player in the same place, is not started for a question.
    if (!player->clone()) return std::nullopt;
    player->start({});
    bool nice = true;
    for (unsigned round = 0; round < rounds_of_niceness && nice; ++round) {
      nice = player->move() == Move::C;
      player->observe(Move::C, Move::C);
    }
    return nice;
  }

  /// More than can be counted is the largest number there is.
  std::optional<std::uint64_t> states() {
    if (!strategy_.machine) return std::nullopt;
    return facts().states ? *facts().states : beyond;
  }

  std::optional<std::uint64_t> memory() {
    if (!strategy_.machine || facts().memory.kind == Memory::Kind::unknown) return std::nullopt;
    return facts().memory.kind == Memory::Kind::rounds ? facts().memory.rounds : beyond;
  }

private:
  static constexpr std::uint64_t beyond = std::numeric_limits<std::uint64_t>::max();

  const Facts& facts() {
    if (!facts_) facts_ = facts_of(*strategy_.machine);
    return *facts_;
  }

  const Strategy& strategy_;
  std::optional<Facts> facts_;
};

using Condition = std::function<std::optional<bool>(Candidate&)>;

[[noreturn]] void refuse(std::string_view condition) {
  throw UsageError(fmt::format(
      "where: '{}' is no condition: machine, finite, deterministic, nice, memory<=2, states<=4, or 'not' before one",
      excerpt(condition)));
}

Condition parse_word(std::string_view text) {
  const std::string word = name_key(text);
  if (word == "machine") return [](Candidate& candidate) { return candidate.machine(); };
  if (word == "finite") return [](Candidate& candidate) { return candidate.finite(); };
  if (word == "deterministic") return [](Candidate& candidate) { return candidate.deterministic(); };
  if (word == "nice") return [](Candidate& candidate) { return candidate.nice(); };
  refuse(text);
}

using Comparison = std::function<bool(std::uint64_t, std::uint64_t)>;

Comparison comparison_of(std::string_view sign, std::string_view condition) {
  if (sign == "<") return std::less<>();
  if (sign == "<=") return std::less_equal<>();
  if (sign == "=") return std::equal_to<>();
  if (sign == ">=") return std::greater_equal<>();
  if (sign == ">") return std::greater<>();
  refuse(condition);
}

Condition parse_bound(std::string_view text, std::size_t begin, std::size_t end) {
  const std::string what = name_key(text.substr(0, begin));
  if (what != "memory" && what != "states") refuse(text);
  constexpr auto most = std::uint64_t{most_counted_states};
  const auto bound = parse_whole_number(std::string(trimmed(text.substr(end))), fmt::format("where {}", what), 0, most);
  return [compare = comparison_of(text.substr(begin, end - begin), text), bound,
          states = what == "states"](Candidate& candidate) -> std::optional<bool> {
    const auto value = states ? candidate.states() : candidate.memory();
    if (!value) return std::nullopt;
    return compare(*value, bound);
  };
}

Condition parse_condition(std::string_view text) {
  if (text.starts_with("not "))
    return [condition = parse_condition(trimmed(text.substr(4)))](Candidate& candidate) -> std::optional<bool> {
      const auto met = condition(candidate);
      return met ? std::optional(!*met) : std::nullopt;
    };
  constexpr std::string_view signs = "<=>";
  const auto begin = text.find_first_of(signs);
  if (begin == std::string_view::npos) return parse_word(text);
  return parse_bound(text, begin, std::min(text.find_first_not_of(signs, begin), text.size()));
}

}  // namespace

std::vector<Strategy> those_that_meet(std::string_view conditions, std::vector<Strategy> strategies) {
  std::vector<Condition> all;
  for (const auto& condition : split_list(conditions)) all.push_back(parse_condition(condition));
  if (all.empty()) refuse(conditions);
  std::erase_if(strategies, [&](const Strategy& strategy) {
    Candidate candidate(strategy);
    return !std::all_of(all.begin(), all.end(),
                        [&](const Condition& condition) { return condition(candidate).value_or(false); });
  });
  return strategies;
}

}  // namespace folk
