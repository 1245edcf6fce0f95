#include <folk/analysis/play/joint_play.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace folk {

JointPlay::JointPlay(const Automaton& first, const Automaton& second, Sense sense, std::size_t most_states)
    : first_(first),
      second_(second),
      sense_(sense) {
  auto nodes = product(first, second, sense, most_states);
  if (!nodes)
    throw UsageError(fmt::format("machines of {} and {} states reach more than {} joint states: too many to check",
                                 first.size(), second.size(), most_states));
  nodes_ = *std::move(nodes);
}

Outcome JointPlay::outcome_in(std::size_t state) const {
  return {first_cooperation(state) > 0.5 ? Move::C : Move::D, second_cooperation(state) > 0.5 ? Move::C : Move::D};
}

std::vector<Outcome> JointPlay::history_to(std::size_t state) const {
  constexpr auto unknown = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::pair<std::uint32_t, Outcome>> from(nodes_.size(), {unknown, {}});  // state before, outcome
  std::vector<std::uint32_t> queue{0};
  from[0].first = 0;
  for (std::size_t i = 0; i < queue.size() && from[state].first == unknown; ++i)
    for (const Outcome outcome : all_outcomes) {
      const auto at = queue[i];
      if (!possible_between(first_cooperation(at), second_cooperation(at), outcome, sense_)) continue;
      const auto next = nodes_[at].next[outcome.index()];
      if (from[next].first != unknown) continue;
      from[next] = {at, outcome};
      queue.push_back(next);
    }
  std::vector<Outcome> history;
  for (std::size_t at = state; at != 0; at = from[at].first) history.push_back(from[at].second);
  std::reverse(history.begin(), history.end());
  return history;
}

}  // namespace folk
