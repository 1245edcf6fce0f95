#include <folk/games/outcome.h>
#include <folk/strategies/product.h>

#include <unordered_map>

namespace folk {

std::optional<std::vector<JointNode>> product(const Automaton& first, const Automaton& second, Sense sense,
                                              std::size_t most_states) {
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  std::vector<JointNode> nodes;
  const auto number = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, fresh] =
        numbers.try_emplace((std::uint64_t{a} << 32U) | b, static_cast<std::uint32_t>(nodes.size()));
    if (fresh) nodes.push_back({a, b, {}});
    return place->second;
  };
  number(static_cast<std::uint32_t>(first.start()), static_cast<std::uint32_t>(second.start()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes.size() > most_states) return std::nullopt;
    const auto& a = first.nodes()[nodes[i].first];
    const auto& b = second.nodes()[nodes[i].second];
    for (const Outcome outcome : all_outcomes) {
      if (!possible_between(a.cooperation, b.cooperation, outcome, sense)) continue;
      const std::uint32_t next = number(a.next[outcome.index()], b.next[outcome.exchanged().index()]);
      nodes[i].next[outcome.index()] = next;
    }
  }
  return nodes;
}

}  // namespace folk
