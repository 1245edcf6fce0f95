#include <folk/analysis/play/deterministic_play.h>
#include <folk/analysis/play/markov_play.h>
#include <folk/analysis/play/pair_player.h>
#include <folk/analysis/play/sampled_play.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

namespace folk {
namespace {

constexpr std::size_t largest_table = 1U << 17U;  // badbet has 90,519 states
constexpr double longest_unrolling = 10'000;
constexpr std::size_t largest_unrolling = 20'000;

/// An automaton as bytes: two minimal automata behave alike iff these are equal.
std::string fingerprint(const Automaton& automaton) {
  const auto* bytes = reinterpret_cast<const char*>(automaton.nodes().data());
  return std::string(bytes, automaton.size() * sizeof(Automaton::Node));
}

UsageError with_names(const UsageError& error, const Strategy& first, const Strategy& second) {
  return UsageError(fmt::format("{} against {}: {}; leave one of them out or play fewer rounds", first.name,
                                second.name, error.what()));
}

}  // namespace

PairPlayer::PairPlayer(const std::vector<Strategy>& roster, const Sampling& sampling, unsigned workers)
    : roster_(roster),
      sampling_(sampling),
      sense_(sampling.noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own),
      finders_(std::max(1U, workers)) {
  std::vector<Prepared> prepared;
  for (const auto& strategy : roster) prepared.push_back(prepare(strategy));
  chance_ = sampling.noise > 0 ||
            !std::all_of(prepared.begin(), prepared.end(), [](const Prepared& p) { return p.deterministic; });
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < roster.size(); ++i) {
    if (chance_ && roster[i].machine && !prepared[i].automaton) unroll_into(prepared[i], *roster[i].machine);
    std::size_t behaviour = behaviours_.size();
    if (prepared[i].automaton) {
      const auto [place, fresh] = known.try_emplace(fingerprint(*prepared[i].automaton), behaviour);
      behaviour = place->second;
    }
    behaviour_of_.push_back(behaviour);
    if (behaviour < behaviours_.size()) continue;
    behaviours_.push_back(i);
    prepared_.push_back(std::move(prepared[i]));
  }
}

PairPlayer::Prepared PairPlayer::prepare(const Strategy& strategy) const {
  Prepared prepared;
  if (!strategy.machine) {
    prepared.deterministic = strategy.deterministic;
    prepared.thinks_together = strategy.thinks_together;
    return prepared;
  }
  prepared.deterministic = strategy.machine->deterministic();
  if (!strategy.machine->finite()) return prepared;
  if (const auto table = tabulate(*strategy.machine, sense_, largest_table)) {
    prepared.automaton = minimise(*table, sense_);
    // A state that mixes may be out of reach.
    prepared.deterministic = prepared.automaton->deterministic();
    if (prepared.deterministic) prepared.cycles.emplace(*prepared.automaton);
  }
  return prepared;
}

void PairPlayer::unroll_into(Prepared& prepared, const Machine& machine) const {
  // A machine without end is finite as far as a few rounds can tell.
  const double rounds = sampling_.criterion.rounds_until_left(1e-17);
  if (!(rounds <= longest_unrolling)) return;
  try {
    prepared.automaton = minimise(unroll(machine, sense_, static_cast<unsigned>(rounds), largest_unrolling), sense_);
  } catch (const UsageError&) {
    // Too many states: its pairs are sampled.
  }
}

PairResult PairPlayer::play(std::size_t a, std::size_t b, unsigned worker) {
  try {
    return play_best(a, b, worker);
  } catch (const UsageError& error) {
    throw with_names(error, strategy(a), strategy(b));
  }
}

std::vector<PairResult> PairPlayer::play_together(const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
                                                  const Progress& progress) const {
  std::vector<Contest> contests;
  for (const auto& [a, b] : pairs) {
    contests.push_back(contest(a, b));
    try {
      check_length(contests.back(), sampling_);
    } catch (const UsageError& error) {
      throw with_names(error, strategy(a), strategy(b));
    }
  }
  return play_sampled(contests, sampling_, progress);
}

void PairPlayer::sign(Signature& signature) const {
  for (std::size_t i = 0; i < roster_.size(); ++i) {
    signature.add(roster_[i].name);
    signature.add(behaviour_of_[i]);
  }
  for (const Prepared& prepared : prepared_)
    if (prepared.automaton) signature.add(*prepared.automaton);
}

Contest PairPlayer::contest(std::size_t a, std::size_t b) const {
  return {&strategy(a), &strategy(b), (std::uint64_t{behaviours_[a]} << 32U) | behaviours_[b],
          sampling_.noise == 0 && prepared_[a].deterministic && prepared_[b].deterministic};
}

PairResult PairPlayer::play_best(std::size_t a, std::size_t b, unsigned worker) {
  const Prepared& x = prepared_[a];
  const Prepared& y = prepared_[b];
  if (sampling_.noise == 0 && x.deterministic && y.deterministic) {
    if (x.cycles && y.cycles && CycleFinder::fits(*x.cycles, *y.cycles))
      return finders_[worker].play(*x.cycles, *y.cycles, sampling_.criterion);
    if (!is_opaque(a) && !is_opaque(b))
      return play_deterministic(*strategy(a).machine, *strategy(b).machine, sampling_.criterion);
  }
  if (x.automaton && y.automaton)
    if (const auto solved = play_markov(*x.automaton, *y.automaton, sampling_.noise, sampling_.criterion))
      return *solved;
  Sampling alone = sampling_;
  alone.threads = 1;  // the other workers play as well
  return play_sampled({contest(a, b)}, alone).front();
}

PairResult play_pair(const Strategy& first, const Strategy& second, const Sampling& sampling) {
  const std::vector<Strategy> roster{first, second};
  PairPlayer player(roster, sampling, 1);
  const std::size_t a = player.behaviour_of()[0];
  const std::size_t b = player.behaviour_of()[1];
  return player.thinks_together(a, b) ? player.play_together({{a, b}}, nullptr).front() : player.play(a, b, 0);
}

}  // namespace folk
