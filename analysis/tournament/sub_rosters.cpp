#include <folk/analysis/play/parallel.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/analysis/tournament/standings.h>
#include <folk/analysis/tournament/sub_rosters.h>
#include <folk/games/error.h>
#include <folk/games/random.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace folk {
namespace {

/// How often an entrant came out at a rank is counted for so many pairs of the two.
constexpr std::size_t most_counts = 10'000'000;

/// What draws, after the roles of a match and of evolution.
constexpr std::uint64_t dealing_role = 6;

using Hand = std::vector<std::size_t>;

/// Binomial coefficient.
Integer sets(std::size_t all, std::size_t chosen) {
  chosen = std::min(chosen, all - chosen);
  Integer count = 1;
  for (std::size_t i = 1; i <= chosen; ++i) count = count * Integer(all - chosen + i) / Integer(i);
  return count;
}

/// The set with this number, of `size` of `all`, in lexicographic order.
Hand set_number(std::uint64_t number, std::size_t all, std::size_t size) {
  Hand hand;
  for (std::size_t entrant = 0; hand.size() < size; ++entrant) {
    const auto with = static_cast<std::uint64_t>(sets(all - entrant - 1, size - hand.size() - 1).word());
    if (number < with)
      hand.push_back(entrant);
    else
      number -= with;
  }
  return hand;
}

/// The set after this one; the last has none.
void to_next_set(Hand& hand, std::size_t all) {
  std::size_t turned = hand.size();
  while (turned > 0 && hand[turned - 1] == all - hand.size() + turned - 1) --turned;
  if (turned == 0) return;
  ++hand[turned - 1];
  for (std::size_t i = turned; i < hand.size(); ++i) hand[i] = hand[i - 1] + 1;
}

/// Shuffled decks of the roster, dealt in hands: where a deck ends, the hand is filled from the next, in which those
/// that it holds already lie at the bottom.
class Dealer {
public:
  Dealer(std::size_t all, const RandomKey& key)
      : deck_(all),
        random_(key) {
    std::iota(deck_.begin(), deck_.end(), std::size_t{0});
  }

  Hand hand(std::size_t size) {
    Hand hand;
    if (left_ < size) {
      hand.assign(deck_.begin(), deck_.begin() + static_cast<std::ptrdiff_t>(left_));
      shuffle(hand);
    }
    while (hand.size() < size) hand.push_back(deck_[--left_]);
    return hand;
  }

private:
  /// Those in `hand` to the bottom.
  void shuffle(const Hand& hand) {
    for (std::size_t i = deck_.size(); i > 1; --i)
      std::swap(deck_[i - 1], deck_[static_cast<std::size_t>(random_.uniform() * static_cast<double>(i))]);
    std::stable_partition(deck_.begin(), deck_.end(), [&](std::size_t entrant) {
      return std::find(hand.begin(), hand.end(), entrant) != hand.end();
    });
    left_ = deck_.size();
  }

  Hand deck_;
  std::size_t left_ = 0;  // the first so many are still to be dealt, from the last of them down
  RandomStream random_;
};

/// Ranks within sub-rosters, one after the other.
class SubRanking {
public:
  explicit SubRanking(const Tournament& tournament)
      : tournament_(tournament),
        all_exact_(true),
        largest_score_(whole_payoffs(tournament.settings().payoffs).largest *
                       tournament.settings().criterion.total_weight()) {
    const std::size_t all = tournament.size();
    totals_.resize(all);
    for (std::size_t i = 0; i < all; ++i) {
      for (std::size_t j = 0; j < all; ++j) {
        totals_[i] += score(i, j);
        all_exact_ = all_exact_ && exact(i, j);
      }
    }
  }

  /// The members with their ranks.
  std::vector<Standing> standings(const Hand& members) const {
    // Of many members it is quicker to take away what they earned against the few others.
    const bool by_others = 2 * members.size() > tournament_.size();
    const Hand opponents = by_others ? outside(members) : members;
    std::vector<Standing> standings;
    for (const std::size_t i : members) {
      Standing standing{i};
      for (const std::size_t j : opponents) standing.total += score(i, j);
      if (by_others) standing.total = totals_[i] - standing.total;
      standing.exact =
          all_exact_ || std::all_of(members.begin(), members.end(), std::bind_front(&SubRanking::exact, this, i));
      standings.push_back(standing);
    }
    const std::size_t met = members.size() - (tournament_.settings().self_play ? 0 : 1);
    rank_by_total(standings, score_rounding * largest_score_ * static_cast<long double>(met));
    return standings;
  }

private:
  long double score(std::size_t i, std::size_t j) const {
    return tournament_.played(i, j) ? static_cast<long double>(tournament_.scaled_score(i, j)) : 0;
  }

  bool exact(std::size_t i, std::size_t j) const {
    return !tournament_.played(i, j) || is_exact(tournament_.method(i, j), tournament_.settings().criterion);
  }

  Hand outside(const Hand& members) const {
    std::vector<bool> inside(tournament_.size());
    for (const std::size_t i : members) inside[i] = true;
    Hand others;
    for (std::size_t i = 0; i < inside.size(); ++i)
      if (!inside[i]) others.push_back(i);
    return others;
  }

  const Tournament& tournament_;
  bool all_exact_;
  long double largest_score_;        // of a pair, in units of the payoffs' last digit, as all scores here
  std::vector<long double> totals_;  // of the whole tournament
};

/// What is said of a strategy that came out so often at each rank, from 1 on.
SubRosterRanks summary(const std::uint64_t* counts, std::size_t ranks) {
  SubRosterRanks summary;
  summary.sub_rosters = std::accumulate(counts, counts + ranks, std::uint64_t{0});
  if (summary.sub_rosters == 0) return summary;
  const auto all = static_cast<double>(summary.sub_rosters);
  std::uint64_t sum = 0;
  for (std::size_t r = 0; r < ranks; ++r) sum += (r + 1) * counts[r];
  summary.mean = static_cast<double>(sum) / all;
  double squares = 0;
  std::uint64_t so_far = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    if (counts[r] == 0) continue;
    const std::size_t rank = r + 1;
    squares += static_cast<double>(counts[r]) * std::pow(static_cast<double>(rank) - summary.mean, 2);
    so_far += counts[r];
    if (summary.best == 0) summary.best = rank;
    if (summary.lower_quartile == 0 && 4 * so_far >= summary.sub_rosters) summary.lower_quartile = rank;
    if (summary.median == 0 && 2 * so_far >= summary.sub_rosters) summary.median = rank;
    if (summary.upper_quartile == 0 && 4 * so_far >= 3 * summary.sub_rosters) summary.upper_quartile = rank;
    summary.worst = rank;
  }
  summary.deviation = std::sqrt(squares / all);
  summary.won = static_cast<double>(counts[0]) / all;
  return summary;
}

}  // namespace

SubRosters rank_sub_rosters(const Tournament& tournament, const SubRosterSettings& settings, const Progress& progress) {
  const std::size_t all = tournament.size();
  const std::size_t size = settings.size;
  if (size < 2 || size > all)
    throw UsageError(fmt::format("sub-rosters of {} strategies: expected from 2 to the {} that there are", size, all));
  if (settings.samples == 0) throw UsageError("no sub-roster is to be drawn: give a number of samples");
  if (all * size > most_counts)
    throw UsageError(
        fmt::format("sub-rosters of {} of {} strategies have too many ranks to count: leave some out", size, all));

  SubRosters result;
  result.size = size;
  result.possible = sets(all, size);
  result.all = result.possible.fits_word() && result.possible <= Integer(settings.samples);
  result.looked_at = result.all ? static_cast<std::uint64_t>(result.possible.word()) : settings.samples;

  // Decks and hands end together after each piece of what is drawn: all are then in as many.
  const std::uint64_t piece_size = result.all ? 1024 : all / std::gcd(all, size);
  const auto pieces = static_cast<std::size_t>((result.looked_at + piece_size - 1) / piece_size);
  const SubRanking ranking(tournament);
  const unsigned threads = std::max(1U, settings.threads);
  std::vector<std::vector<std::uint64_t>> counts(threads);  // of each worker: entrant * size + rank - 1
  parallel_for(
      pieces, threads,
      [&](std::size_t piece, unsigned worker) {
        counts[worker].resize(all * size);
        const std::uint64_t first = piece * piece_size;
        const std::uint64_t last = std::min(result.looked_at, first + piece_size);
        Dealer dealer(all, {settings.seed, 0, piece, dealing_role});
        Hand hand = result.all ? set_number(first, all, size) : dealer.hand(size);
        for (std::uint64_t number = first; number < last; ++number) {
          progress.check();
          for (const Standing& standing : ranking.standings(hand))
            ++counts[worker][standing.entrant * size + standing.rank - 1];
          if (number + 1 == last) break;
          if (result.all)
            to_next_set(hand, all);
          else
            hand = dealer.hand(size);
        }
      },
      progress);

  std::vector<std::uint64_t> together(all * size);
  for (const auto& of_worker : counts)
    for (std::size_t i = 0; i < of_worker.size(); ++i) together[i] += of_worker[i];
  for (std::size_t i = 0; i < all; ++i) result.ranks.push_back(summary(&together[i * size], size));
  result.best_first.resize(all);
  std::iota(result.best_first.begin(), result.best_first.end(), std::size_t{0});
  std::stable_sort(result.best_first.begin(), result.best_first.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) { return std::pair(result.ranks[i].sub_rosters == 0, result.ranks[i].mean); };
    return key(a) < key(b);
  });
  return result;
}

}  // namespace folk
