#include <folk/analysis/classes/class_score.h>
#include <folk/analysis/classes/path_value.h>
#include <folk/analysis/play/cycle_table.h>
#include <folk/analysis/play/parallel.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/strategies/automaton.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace folk {
namespace {

__extension__ using Wide = __int128;

/// Room for the marks of so many joint states, 256 MB.
constexpr std::size_t most_joint_states = std::size_t{1} << 26;

/// So many genes are chosen before a piece of work begins: 2^8 pieces for the threads.
constexpr unsigned chosen_ahead = 8;

Integer integer(Wide value) {
  const bool negative = value < 0;
  const Wide size = negative ? -value : value;
  const Integer both =
      (Integer(static_cast<std::uint64_t>(size >> 64)) << 64) + Integer(static_cast<std::uint64_t>(size));
  return negative ? -both : both;
}

/// What paths bring to the entrant, and what its opponents earn.
struct Values {
  double own = 0;
  double theirs = 0;
  double cooperations = 0;

  friend Values operator+(const Values& a, const Values& b) {
    return {a.own + b.own, a.theirs + b.theirs, a.cooperations + b.cooperations};
  }
  friend Values operator-(const Values& a, const Values& b) {
    return {a.own - b.own, a.theirs - b.theirs, a.cooperations - b.cooperations};
  }
  friend Values operator*(double factor, const Values& a) {
    return {factor * a.own, factor * a.theirs, factor * a.cooperations};
  }
};

/// Sums over the leaves for which equally many genes were asked.
struct Sums {
  // For finite whole numbers in the first place; for mean the sums over cycles, by their length; else rounded numbers.
  std::vector<Wide> own;
  std::vector<Wide> cooperations;
  long double rounded_own = 0;
  long double rounded_cooperations = 0;
  std::uint64_t beats = 0;
  std::uint64_t draws = 0;
  std::uint64_t leaves = 0;

  void add(std::size_t length, Wide more_own, Wide more_cooperations) {
    if (own.size() <= length) {
      own.resize(length + 1);
      cooperations.resize(length + 1);
    }
    own[length] += more_own;
    cooperations[length] += more_cooperations;
  }

  Sums& operator+=(const Sums& more) {
    for (std::size_t length = 0; length < more.own.size(); ++length)
      add(length, more.own[length], more.cooperations[length]);
    rounded_own += more.rounded_own;
    rounded_cooperations += more.rounded_cooperations;
    beats += more.beats;
    draws += more.draws;
    leaves += more.leaves;
    return *this;
  }
};

/// The leaf that stands out so far; genes that were not asked are C.
struct Extreme {
  bool any = false;
  double value = 0;
  std::vector<char> genes;  // 1 for D

  void offer(double offered, const std::vector<char>& moves, bool less) {
    if (any && (less ? offered > value : offered < value)) return;
    if (any && offered == value && genes <= moves) return;
    any = true;
    value = offered;
    genes = moves;
  }
};

/// What one piece of work, or all of them, found.
struct Found {
  std::vector<Sums> by_asked;
  Extreme best;
  Extreme worst;

  Found& operator+=(const Found& more) {
    if (by_asked.size() < more.by_asked.size()) by_asked.resize(more.by_asked.size());
    for (std::size_t asked = 0; asked < more.by_asked.size(); ++asked) by_asked[asked] += more.by_asked[asked];
    if (more.best.any) best.offer(more.best.value, more.best.genes, false);
    if (more.worst.any) worst.offer(more.worst.value, more.worst.genes, true);
    return *this;
  }
};

class Revelation {
public:
  Revelation(const MemoryClass& members, const CycleTable& entrant, const ClassScoreSettings& settings,
             const WholePayoffs& payoffs)
      : members_(members),
        entrant_(&entrant),
        criterion_(settings.criterion),
        exact_(settings.criterion.is_finite() || settings.criterion.kind() == Criterion::Kind::mean),
        tolerance_(exact_ ? 0 : score_rounding * payoffs.largest * settings.criterion.total_weight()),
        last_(settings.criterion.is_finite() ? settings.criterion.rounds() : std::numeric_limits<std::uint64_t>::max()),
        marks_(entrant.size() * members.entries(), 0),
        moves_(members.genes(), 0),
        known_(members.genes(), 0),
        sums_(1) {
    for (std::size_t o = 0; o < 4; ++o) {
      const std::size_t exchanged = all_outcomes[o].exchanged().index();
      rounds_[o] = {payoffs.by_outcome[o], payoffs.by_outcome[exchanged], o < 2 ? 1.0 : 0.0};
    }
  }

  /// Everything that begins with these answers to the first questions, the first answer in the highest of `ahead` bits.
  Found run(std::size_t answers, unsigned ahead, const Progress& progress, std::atomic<std::uint64_t>& leaves,
            std::uint64_t most_leaves) {
    answers_ = answers;
    ahead_ = ahead;
    progress_ = &progress;
    all_leaves_ = &leaves;
    most_leaves_ = most_leaves;
    found_ = {};
    found_.by_asked.resize(members_.genes() + 1);
    walk(0, entrant_->start(), 0, 0, 0);
    report();
    return std::exchange(found_, {});
  }

private:
  /// From round t on; `own` and `theirs` are the member's histories, `asked` its genes that are known.
  void walk(std::size_t t, std::uint32_t entrant, unsigned own, unsigned theirs, unsigned asked) {
    const std::size_t begin = t;
    for (;; ++t) {
      if (t == last_) {
        leaf(t, t, asked);
        break;
      }
      unsigned gene = static_cast<unsigned>(t);
      if (t >= members_.openings()) {
        const unsigned entry = (own << members_.their_memory()) | theirs;
        gene = members_.openings() + entry;
        std::uint32_t& mark = marks_[(entrant >> 1U) * members_.entries() + entry];
        if (mark != 0) {
          leaf(mark - 1, t, asked);
          break;
        }
        mark = static_cast<std::uint32_t>(t + 1);
        marked_.push_back(&mark);
      }
      if (known_[gene] == 0) {
        known_[gene] = 1;
        for (const unsigned move : {0U, 1U}) {
          if (asked < ahead_ && ((answers_ >> (ahead_ - 1 - asked)) & 1U) != move) continue;
          moves_[gene] = static_cast<char>(move);
          const auto [e, o, h] = after(t, entrant, own, theirs, move);
          walk(t + 1, e, o, h, asked + 1);
        }
        moves_[gene] = 0;
        known_[gene] = 0;
        ++t;
        break;
      }
      std::tie(entrant, own, theirs) = after(t, entrant, own, theirs, static_cast<unsigned>(moves_[gene]));
    }
    const std::size_t first = std::max<std::size_t>(begin, members_.openings());
    for (; t > first && !marked_.empty(); --t) {
      *marked_.back() = 0;
      marked_.pop_back();
    }
  }

  /// The states after round t in which the member plays `move`.
  std::tuple<std::uint32_t, unsigned, unsigned> after(std::size_t t, std::uint32_t entrant, unsigned own,
                                                      unsigned theirs, unsigned move) {
    if (sums_.size() <= t + 1) sums_.resize(t + 2);
    if (weights_.size() <= t) weights_ = round_weights<double>(criterion_, 2 * t + 64);
    const unsigned entrant_move = entrant & 1U;
    sums_[t + 1] = sums_[t] + weights_[t] * rounds_[2 * entrant_move + move];
    const auto shifted = [](unsigned history, unsigned last, unsigned length) {
      return ((history << 1U) | last) & ((1U << length) - 1);
    };
    return {entrant_->next(entrant, move), shifted(own, move, members_.own_memory()),
            shifted(theirs, entrant_move, members_.their_memory())};
  }

  void leaf(std::size_t begin, std::size_t end, unsigned asked) {
    // An answer that was never asked for is taken once.
    if (asked < ahead_ && (answers_ & ((std::size_t{1} << (ahead_ - asked)) - 1)) != 0) return;
    Sums& sums = found_.by_asked[asked];
    const Values value = path_term<double>(criterion_, begin, end).value(sums_.data(), begin, end);
    if (criterion_.is_finite()) {
      sums.add(0, static_cast<Wide>(value.own), static_cast<Wide>(value.cooperations));
    } else if (exact_) {
      const Values cycle = sums_[end] - sums_[begin];
      sums.add(end - begin, static_cast<Wide>(cycle.own), static_cast<Wide>(cycle.cooperations));
    } else {
      sums.rounded_own += value.own;
      sums.rounded_cooperations += value.cooperations;
    }
    const double margin = exact_ && !criterion_.is_finite()
                              ? (sums_[end] - sums_[begin]).own - (sums_[end] - sums_[begin]).theirs
                              : value.own - value.theirs;
    if (margin > tolerance_) {
      ++sums.beats;
    } else if (margin >= -tolerance_) {
      ++sums.draws;
    }
    ++sums.leaves;
    found_.best.offer(value.own, moves_, false);
    found_.worst.offer(value.own, moves_, true);
    if (++unreported_ == 1U << 14) report();
  }

  void report() {
    progress_->check();
    if ((*all_leaves_ += std::exchange(unreported_, 0)) > most_leaves_)
      throw TooManyKinds(
          fmt::format("it tells more than {} kinds of opponents in {} apart", most_leaves_, members_.name()));
  }

  MemoryClass members_;
  const CycleTable* entrant_;
  Criterion criterion_;
  bool exact_;
  double tolerance_;
  std::uint64_t last_;
  std::array<Values, 4> rounds_{};
  std::vector<std::uint32_t> marks_;  // of a joint state: one more than the round in which play stood there
  std::vector<std::uint32_t*> marked_;
  std::vector<char> moves_;  // of each gene, 1 for D; C where it is not known
  std::vector<char> known_;
  std::vector<Values> sums_;  // prefix sums
  std::vector<double> weights_;
  Found found_;
  std::size_t answers_ = 0;
  unsigned ahead_ = 0;
  const Progress* progress_ = nullptr;
  std::atomic<std::uint64_t>* all_leaves_ = nullptr;
  std::uint64_t most_leaves_ = 0;
  std::uint64_t unreported_ = 0;
};

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

std::string genotype(const MemoryClass& members, const std::vector<char>& genes) {
  return members.member(std::vector<bool>(genes.begin(), genes.end())).name();
}

}  // namespace

ClassScore score_against(const MemoryClass& members, const Machine& entrant, const ClassScoreSettings& settings,
                         const Progress& progress) {
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
  std::vector<Found> found(pieces);
  std::atomic<std::uint64_t> leaves{0};
  parallel_for(
      pieces, settings.threads,
      [&](std::size_t piece, unsigned worker) {
        found[piece] = workers[worker].run(piece, ahead, progress, leaves, settings.most_leaves);
      },
      progress);
  Found all;
  for (const Found& piece : found) all += piece;

  ClassScore score;
  Rational own;
  Rational cooperations;
  long double rounded_own = 0;
  long double rounded_cooperations = 0;
  for (unsigned asked = 0; asked < all.by_asked.size(); ++asked) {
    const Sums& sums = all.by_asked[asked];
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

}  // namespace folk
