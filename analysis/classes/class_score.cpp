#include <folk/analysis/classes/class_score.h>
#include <folk/analysis/classes/revelation.h>
#include <folk/analysis/play/signature.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/games/error.h>
#include <folk/games/int128.h>
#include <folk/strategies/automaton.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

namespace folk {
namespace {

/// Room for the marks of so many joint states, 256 MB.
constexpr std::size_t most_joint_states = std::size_t{1} << 26;

/// So many genes are chosen before a piece of work begins: 2^8 pieces for the threads.
constexpr unsigned chosen_ahead = 8;

Integer integer(Int128 value) {
  const bool negative = value < 0;
  const Int128 size = negative ? -value : value;
  const Integer both =
      (Integer(static_cast<std::uint64_t>(size >> 64)) << 64) + Integer(static_cast<std::uint64_t>(size));
  return negative ? -both : both;
}

/// Of all that a score depends on; `automaton` is minimal.
std::uint64_t identity_of(const MemoryClass& members, const Automaton& automaton, const ClassScoreSettings& settings) {
  Signature signature;
  signature.add("score against a class");
  signature.add(members.name());
  signature.add(to_text(settings.payoffs));
  signature.add(settings.criterion.to_string());
  signature.add(settings.most_leaves);
  signature.add(automaton);
  return signature.value();
}

Automaton table_of(const Machine& entrant, const Criterion& criterion) {
  constexpr Sense sense = Sense::own_moves_its_own;
  if (!entrant.deterministic())
    throw UsageError("it mixes: a class is gone through with a strategy that plays without chance");
  if (entrant.finite()) {
    if (auto automaton = tabulate(entrant, sense)) return *std::move(automaton);
    throw UsageError("it has too many states");
  }
  constexpr std::uint64_t longest = 100'000;
  if (!criterion.is_finite() || criterion.rounds() > longest)
    throw UsageError(fmt::format("it has no end of states: give it at most {} rounds", longest));
  return unroll(entrant, sense, static_cast<unsigned>(criterion.rounds()));
}

std::string genotype(const MemoryClass& members, const Genotype& genes) {
  return members.member(std::vector<bool>(genes.begin(), genes.end())).name();
}

/// What the leaves say, by the genes that were asked: 2^(genes - asked) members share a leaf.
ClassScore score_of(const MemoryClass& members, const Criterion& criterion, const WholePayoffs& payoffs,
                    const Revealed& all) {
  ClassScore score;
  Rational own;
  Rational cooperations;
  long double rounded_own = 0;
  long double rounded_cooperations = 0;
  for (unsigned asked = 0; asked < all.by_asked.size(); ++asked) {
    const RevealedSums& sums = all.by_asked[asked];
    const Integer members_each = pow(Integer(2), members.genes() - asked);
    score.beats += Integer(sums.beats) * members_each;
    score.draws += Integer(sums.draws) * members_each;
    score.leaves += sums.leaves;
    for (std::size_t length = 0; length < sums.own.size(); ++length) {
      const Integer below = pow(Integer(2), asked) * Integer(std::max<std::size_t>(1, length));
      own += Rational(integer(sums.own[length]), below);
      cooperations += Rational(integer(sums.cooperations[length]), below);
    }
    rounded_own += std::ldexp(sums.rounded_own, -static_cast<int>(asked));
    rounded_cooperations += std::ldexp(sums.rounded_cooperations, -static_cast<int>(asked));
  }
  score.loses = members.size() - score.beats - score.draws;
  const double weight = criterion.total_weight();
  if (criterion.is_finite() || criterion.kind() == Criterion::Kind::mean) {
    const Rational rounds = criterion.is_finite() ? Rational(criterion.rounds()) : Rational(1);
    score.exact_mean = own / payoffs.exact_scale / rounds;
    score.exact_cooperation_rate = cooperations / rounds;
    score.mean = to_double(*score.exact_mean);
    score.cooperation_rate = to_double(*score.exact_cooperation_rate);
  } else {
    score.mean = static_cast<double>(rounded_own) / payoffs.scale / weight;
    score.cooperation_rate = static_cast<double>(rounded_cooperations) / weight;
  }
  score.best = {all.best.value / payoffs.scale / weight, genotype(members, all.best.genes)};
  score.worst = {all.worst.value / payoffs.scale / weight, genotype(members, all.worst.genes)};
  return score;
}

}  // namespace

ClassScore score_against(const MemoryClass& members, const Machine& entrant, const ClassScoreSettings& settings,
                         const Progress& progress, const Crew& crew) {
  const Criterion& criterion = settings.criterion;
  const WholePayoffs payoffs = whole_payoffs(settings.payoffs);
  if (criterion.is_finite() && !payoffs.exact(static_cast<double>(criterion.rounds())))
    throw UsageError(
        fmt::format("scores under {} are too large to count exactly: play fewer rounds or give payoffs of "
                    "fewer digits",
                    criterion.to_string()));
  const Automaton automaton = minimise(table_of(entrant, criterion), Sense::own_moves_its_own);
  if (automaton.size() * members.entries() > most_joint_states)
    throw UsageError(fmt::format("its {} states are too many beside {}", automaton.size(), members.name()));
  const CycleTable table(automaton);

  const unsigned ahead = std::min(chosen_ahead, members.genes());
  const std::size_t pieces = std::size_t{1} << ahead;
  std::vector<Revelation> workers(std::max(1U, settings.threads), Revelation(members, table, settings, payoffs));
  std::vector<Revealed> found(pieces);
  std::atomic<std::uint64_t> leaves{0};
  crew.run({[&] { return identity_of(members, automaton, settings); }, pieces, settings.threads,
            [&](std::size_t piece, unsigned worker) {
              found[piece] = workers[worker].run(piece, ahead, progress, leaves, settings.most_leaves);
            },
            [&](std::size_t piece) { return found[piece].packed(); },
            [&](std::size_t piece, std::string_view bytes) { found[piece].unpack(bytes); }},
           progress);
  Revealed all;
  for (const Revealed& piece : found) all += piece;
  // Each rank counts its own leaves: only now is it known how many there are in all.
  std::uint64_t in_all = 0;
  for (const RevealedSums& sums : all.by_asked) in_all += sums.leaves;
  if (all.given_up || in_all > settings.most_leaves)
    throw TooManyKinds(
        fmt::format("it tells more than {} kinds of opponents in {} apart", settings.most_leaves, members.name()));
  return score_of(members, criterion, payoffs, all);
}

}  // namespace folk
