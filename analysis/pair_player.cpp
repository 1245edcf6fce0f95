#include <folk/analysis/deterministic_play.h>
#include <folk/analysis/markov_play.h>
#include <folk/analysis/pair_player.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

namespace folk {
namespace {

constexpr std::size_t largest_table = 1U << 16U;
constexpr std::uint64_t longest_unrolling = 10'000;
constexpr std::size_t largest_unrolling = 20'000;

/// An automaton as bytes: two minimal automata behave alike iff these are equal.
std::string fingerprint(const Automaton& automaton) {
  const auto* bytes = reinterpret_cast<const char*>(automaton.nodes().data());
  return std::string(bytes, automaton.size() * sizeof(Automaton::Node));
}

bool is_deterministic(const Strategy& strategy) { return strategy.machine && strategy.machine->deterministic(); }

}  // namespace

PairPlayer::PairPlayer(const std::vector<Strategy>& roster, const Sampling& sampling, unsigned workers)
    : roster_(roster),
      sampling_(sampling),
      sense_(sampling.noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own),
      chance_(sampling.noise > 0 || !std::all_of(roster.begin(), roster.end(), is_deterministic)),
      finders_(std::max(1U, workers)) {
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < roster.size(); ++i) {
    Prepared prepared = prepare(roster[i]);
    std::size_t behaviour = behaviours_.size();
    if (prepared.automaton) {
      const auto [place, fresh] = known.try_emplace(fingerprint(*prepared.automaton), behaviour);
      behaviour = place->second;
    }
    behaviour_of_.push_back(behaviour);
    if (behaviour < behaviours_.size()) continue;
    behaviours_.push_back(i);
    prepared_.push_back(std::move(prepared));
  }
}

std::optional<Automaton> PairPlayer::table_of(const Machine& machine) const {
  if (machine.finite())
    if (auto table = tabulate(machine, sense_, largest_table)) return table;
  // A machine without end is finite as far as a few rounds can tell.
  if (!chance_ || !sampling_.criterion.is_finite() || sampling_.criterion.rounds() > longest_unrolling)
    return std::nullopt;
  try {
    return unroll(machine, sense_, static_cast<unsigned>(sampling_.criterion.rounds()), largest_unrolling);
  } catch (const UsageError&) {
    return std::nullopt;  // too many states
  }
}

PairPlayer::Prepared PairPlayer::prepare(const Strategy& strategy) const {
  if (!strategy.machine) return {};
  auto table = table_of(*strategy.machine);
  if (!table) return {};
  Prepared prepared{minimise(*table, sense_), std::nullopt};
  // The cycle of an unrolled machine would be that of its cut.
  if (prepared.automaton->deterministic() && !table->beyond()) prepared.cycles.emplace(*prepared.automaton);
  return prepared;
}

PairResult PairPlayer::play(std::size_t a, std::size_t b, unsigned worker) {
  try {
    return play_best(a, b, worker);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{} against {}: {}; leave one of them out (--exclude) or play fewer rounds",
                                 roster_[behaviours_[a]].name, roster_[behaviours_[b]].name, error.what()));
  }
}

PairResult PairPlayer::play_best(std::size_t a, std::size_t b, unsigned worker) {
  const Strategy& first = roster_[behaviours_[a]];
  const Strategy& second = roster_[behaviours_[b]];
  const Prepared& x = prepared_[a];
  const Prepared& y = prepared_[b];
  if (sampling_.noise == 0 && is_deterministic(first) && is_deterministic(second)) {
    if (x.cycles && y.cycles && CycleFinder::fits(*x.cycles, *y.cycles))
      return finders_[worker].play(*x.cycles, *y.cycles, sampling_.criterion);
    return play_deterministic(*first.machine, *second.machine, sampling_.criterion);
  }
  if (x.automaton && y.automaton)
    if (const auto solved = play_markov(*x.automaton, *y.automaton, sampling_.noise, sampling_.criterion))
      return *solved;
  return play_sampled(first, second, (std::uint64_t{behaviours_[a]} << 32U) | behaviours_[b], sampling_);
}

}  // namespace folk
