#include <folk/analysis/judgement/agreement.h>
#include <folk/games/error.h>
#include <folk/games/noise.h>

#include <fmt/format.h>

#include <cmath>

namespace folk {

void Agreement::add(double chance, RecordedPlace place) {
  ++rounds_by_chance_[chance];
  ++rounds_;
  if (chance == 0 && !first_impossible_) first_impossible_ = place;
}

bool Agreement::certain() const { return rounds_by_chance_.empty() || rounds_by_chance_.begin()->first == 1; }

std::uint64_t Agreement::impossible() const {
  const auto never = rounds_by_chance_.find(0);
  return never == rounds_by_chance_.end() ? 0 : never->second;
}

double Agreement::log_likelihood(double slip) const {
  double sum = 0;
  for (const auto& [chance, rounds] : rounds_by_chance_)
    sum += static_cast<double>(rounds) * std::log(really_played(chance, slip)[0]);
  return sum;
}

std::vector<double> cooperation_along(const Strategy& strategy, const BeliefMatch& match, Seat seat,
                                      const Payoffs& payoffs) {
  std::vector<double> chances;
  chances.reserve(match.size());
  if (strategy.machine) {
    State state = strategy.machine->start();
    for (const Outcome& round : match) {
      chances.push_back(strategy.machine->cooperation(state));
      const Outcome seen = seen_from(seat, round);
      state = strategy.machine->next(state, seen.own, seen.theirs);
    }
    return chances;
  }
  if (!strategy.deterministic)
    throw UsageError(
        fmt::format("{} draws random numbers and is no machine: how likely its moves are is not known", strategy.name));
  const auto player = strategy.new_player();
  player->start({payoffs, Criterion::finite(match.size()), {}});
  for (const Outcome& round : match) {
    chances.push_back(player->move() == Move::C ? 1 : 0);
    const Outcome seen = seen_from(seat, round);
    player->observe(seen.own, seen.theirs);
  }
  player->finish();
  return chances;
}

Agreement agreement_with(const Strategy& strategy, std::span<const RecordedMatch> matches, Seat seat,
                         const Payoffs& payoffs) {
  Agreement agreement;
  for (std::size_t m = 0; m < matches.size(); ++m) {
    const BeliefMatch& rounds = matches[m].rounds;
    const auto chances = cooperation_along(strategy, rounds, seat, payoffs);
    for (std::size_t t = 0; t < rounds.size(); ++t)
      agreement.add(seen_from(seat, rounds[t]).own == Move::C ? chances[t] : 1 - chances[t], {m, t});
  }
  return agreement;
}

}  // namespace folk
