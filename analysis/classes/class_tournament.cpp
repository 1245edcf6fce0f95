#include <folk/analysis/classes/class_tournament.h>
#include <folk/analysis/classes/joint_walk.h>
#include <folk/analysis/classes/own_copy.h>
#include <folk/analysis/crew/packing.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>

namespace folk {
namespace {

/// Table entries of the first player that one piece of work leaves open: 3^11 cells of 32 bytes stay in a processor's
/// caches.
constexpr unsigned most_open = 11;

/// The genes of one piece of work. The first player's openings and some of its table entries are fixed; each of its
/// other entries is C, D or not asked for, a digit 0, 1 or 2 of the place where its leaf is added up.
///
/// Sum is std::int64_t beside Number double where paths are rounded to ClassScale's fixed point, else it is Number.
template <class Number, class Sum>
class SubcubeSums {
  static constexpr bool fixed_point = !std::is_same_v<Number, Sum>;

public:
  SubcubeSums(const MemoryClass& members, const ClassScale& scale, const Progress& progress)
      : members_(members),
        progress_(&progress),
        genes_(members.genes()),
        open_(std::min(members.entries(), most_open)),
        tolerance_(static_cast<Number>(scale.tolerance)),
        unit_(static_cast<Number>(scale.cooperation_unit)),
        power_(genes_, 0) {
    std::size_t cells = 1;
    for (unsigned gene = 0; gene < open_; ++gene) cells *= 3;
    cells_.resize(cells);
  }

  /// How many genes of the first player are fixed at a time.
  unsigned fixed() const { return genes_ - open_; }

  /// Sums what the first player earns from all, for each member with the fixed genes of piece number `piece`, into
  /// its place in `totals`.
  void add_up(JointWalk<Number>& walk, std::uint32_t piece, std::span<MemberTotals> totals) {
    order_genes(piece);
    First first{0, 0, cells_.size() - 1};  // all digits 2
    std::uint32_t member = 0;
    for (unsigned i = 0; i < fixed(); ++i) {
      const std::uint32_t move = (piece >> (fixed() - 1 - i)) & 1U;
      first.known |= 1U << order_[i];
      first.moves |= move << order_[i];
      member |= move << (genes_ - 1 - order_[i]);
    }
    walk.run(*this, first, Second{0, 0, static_cast<Sum>(std::int64_t{1} << genes_)});
    spread(0, cells_.size(), fixed(), member, totals);
  }

  /// The members with the fixed genes of a piece.
  template <class Visit>
  void each_member(std::uint32_t piece, Visit&& visit) const {
    const auto order = order_of(piece);
    for (std::uint32_t rest = 0; rest < 1U << open_; ++rest) {
      const std::uint32_t moves = (piece << open_) | rest;
      std::uint32_t member = 0;
      for (unsigned i = 0; i < genes_; ++i) member |= ((moves >> (genes_ - 1 - i)) & 1U) << (genes_ - 1 - order[i]);
      visit(member);
    }
  }

  /// Genes as bits, the first gene lowest.
  struct First {
    std::uint32_t known = 0;
    std::uint32_t moves = 0;
    std::size_t place = 0;
  };

  struct Second {
    std::uint32_t known = 0;
    std::uint32_t moves = 0;
    Sum opponents = 0;  ///< that have these genes
  };

  bool first(First& chosen, unsigned gene, unsigned move) const {
    const std::uint32_t bit = 1U << gene;
    if ((chosen.known & bit) != 0) return ((chosen.moves >> gene) & 1U) == move;
    chosen.known |= bit;
    chosen.moves |= move << gene;
    chosen.place -= (2 - move) * power_[gene];
    return true;
  }

  bool second(Second& chosen, unsigned gene, unsigned move) const {
    const std::uint32_t bit = 1U << gene;
    if ((chosen.known & bit) != 0) return ((chosen.moves >> gene) & 1U) == move;
    chosen.known |= bit;
    chosen.moves |= move << gene;
    chosen.opponents /= 2;
    return true;
  }

  /// Sums over leaves of one place: score, cooperations, wins and draws.
  struct Leaves {
    Lanes<Sum> totals{};
    bool any = false;
  };

  void leaf(Leaves& leaves, const Second& second, const Lanes<Number>& path) const {
    const Number margin = path[own_payoff] - path[their_payoff];
    const auto wins = static_cast<Sum>(margin > tolerance_);
    const auto draws = static_cast<Sum>(margin >= -tolerance_) - wins;
    Lanes<Sum> totals{};
    if constexpr (fixed_point) {
      const auto fixed = __builtin_convertvector(path * unit_, Lanes<Sum>);
      totals = Lanes<Sum>{fixed[own_payoff], fixed[own_cooperations], wins, draws};
    } else {
      totals = Lanes<Sum>{path[own_payoff], path[own_cooperations], wins, draws};
    }
    leaves.totals += totals * second.opponents;
    leaves.any = true;
  }

  void add(const First& first, const Leaves& leaves) {
    if ((++added_ & 0xffffU) == 0) progress_->check();
    if (leaves.any) cells_[first.place] += __builtin_convertvector(leaves.totals, Lanes<std::int64_t>);
  }

private:
  /// Fixed genes first. A match that asks for few of the fixed entries is walked in many pieces, so those are fixed
  /// that most matches ask for: where a player does the opposite of its last opening it comes by an entry of that
  /// memory, and entry 0, permanent cooperation, is left early or never.
  std::vector<unsigned> order_of(std::uint32_t piece) const {
    const unsigned last_opening = (piece >> (fixed() - members_.openings())) & 1U;
    const unsigned moves = std::min(2U, members_.own_memory());
    const unsigned changed = moves == 2 ? (last_opening << 1U) | (last_opening ^ 1U) : last_opening ^ 1U;
    const auto changes = [&](unsigned gene) {
      const unsigned own = (gene - members_.openings()) >> members_.their_memory();
      return moves > 0 && (own & ((1U << moves) - 1)) == changed;
    };
    std::vector<unsigned> order(genes_);
    std::iota(order.begin(), order.end(), 0U);
    const auto entries = order.begin() + members_.openings();
    std::rotate(entries, entries + 1, order.end());
    std::stable_partition(entries, order.end(), changes);
    std::sort(order.begin() + fixed(), order.end());
    return order;
  }

  void order_genes(std::uint32_t piece) {
    order_ = order_of(piece);
    std::size_t power = 1;
    for (unsigned i = genes_; i-- > fixed(); power *= 3) power_[order_[i]] = power;
  }

  /// Adds what stands for both moves of an entry to each of them, entry by entry; a cell without a 2 is a member.
  /// Leaves all cells empty. `next` is the place in the order of the first gene that is not yet in `member`.
  void spread(std::size_t begin, std::size_t cells, unsigned next, std::uint32_t member,
              std::span<MemberTotals> totals) {
    Lanes<std::int64_t>* const c = cells_.data() + begin;
    if (cells == 1) {
      totals[member] = {c[0][0], c[0][1], c[0][2], c[0][3]};
      c[0] = Lanes<std::int64_t>{};
      return;
    }
    const std::size_t third = cells / 3;
    for (std::size_t i = 0; i < third; ++i) {
      c[i] += c[2 * third + i];
      c[third + i] += c[2 * third + i];
      c[2 * third + i] = Lanes<std::int64_t>{};
    }
    spread(begin, third, next + 1, member, totals);
    spread(begin + third, third, next + 1, member | (1U << (genes_ - 1 - order_[next])), totals);
  }

  MemoryClass members_;
  const Progress* progress_;  // a piece may take seconds
  std::uint64_t added_ = 0;
  unsigned genes_;
  unsigned open_;
  Number tolerance_;
  Number unit_;
  std::vector<unsigned> order_;     // of the genes
  std::vector<std::size_t> power_;  // of 3, by gene
  std::vector<Lanes<std::int64_t>> cells_;
};

/// Of all that the totals depend on.
std::uint64_t identity_of(const MemoryClass& members, const ClassSettings& settings) {
  Signature signature;
  signature.add("totals of a class");
  signature.add(members.name());
  signature.add(to_text(settings.payoffs));
  signature.add(settings.criterion.to_string());
  signature.add(std::uint64_t{settings.self_play ? 1U : 0U});
  return signature.value();
}

template <class Number, class Sum>
std::vector<MemberTotals> all_totals(const MemoryClass& members, const ClassSettings& settings, const ClassScale& scale,
                                     const Progress& progress, const Crew& crew) {
  const JointWalk<Number> walk(members, settings.criterion, scale.payoffs.by_outcome,
                               static_cast<Number>(scale.common));
  struct Worker {
    JointWalk<Number> walk;
    SubcubeSums<Number, Sum> sums;
  };
  std::vector<Worker> workers(std::max(1U, settings.threads), Worker{walk, {members, scale, progress}});
  std::vector<MemberTotals> totals(std::size_t{1} << members.genes());
  const double unit = scale.exact ? 1 : scale.cooperation_unit;
  const auto each_member = [&](std::size_t piece, auto&& visit) {
    workers[0].sums.each_member(static_cast<std::uint32_t>(piece), visit);
  };
  crew.run({[&] { return identity_of(members, settings); }, std::size_t{1} << workers[0].sums.fixed(), settings.threads,
            [&](std::size_t piece, unsigned worker) {
              workers[worker].sums.add_up(workers[worker].walk, static_cast<std::uint32_t>(piece), totals);
              if (settings.self_play) return;
              each_member(piece, [&](std::uint32_t member) {
                const auto path = own_copy(workers[worker].walk, members, member);
                totals[member].score -= static_cast<std::int64_t>(static_cast<double>(path[own_payoff]) * unit);
                totals[member].cooperations -=
                    static_cast<std::int64_t>(static_cast<double>(path[own_cooperations]) * unit);
                totals[member].draws -= 1;
              });
            },
            [&](std::size_t piece) {
              std::string bytes;
              each_member(piece, [&](std::uint32_t member) { pack(bytes, totals[member]); });
              return bytes;
            },
            [&](std::size_t piece, std::string_view bytes) {
              Unpacker unpacker(bytes);
              each_member(piece, [&](std::uint32_t member) { totals[member] = unpacker.number<MemberTotals>(); });
              unpacker.end();
            }},
           progress);
  return totals;
}

}  // namespace

ClassTournament play_class(const MemoryClass& members, const ClassSettings& settings, const Progress& progress,
                           const Crew& crew) {
  if (members.entries() > most_ranked_entries)
    throw UsageError(fmt::format("{} has {} members: a class is ranked as a whole up to X + Y = 4", members.name(),
                                 members.size_text()));
  const auto size = static_cast<double>(std::uint64_t{1} << members.genes());
  ClassScale scale = class_scale(members, settings.payoffs, settings.criterion, size);
  const double largest = settings.criterion.total_weight() * scale.payoffs.largest * static_cast<double>(scale.common);
  auto totals = !scale.exact ? all_totals<double, std::int64_t>(members, settings, scale, progress, crew)
                : largest * size <= 0x1p53
                    ? all_totals<double, double>(members, settings, scale, progress, crew)
                    : all_totals<std::int64_t, std::int64_t>(members, settings, scale, progress, crew);
  return {members, settings, std::move(scale), std::move(totals)};
}

ClassTournament::ClassTournament(const MemoryClass& members, const ClassSettings& settings, ClassScale scale,
                                 std::vector<MemberTotals> totals)
    : members_(members),
      settings_(settings),
      scale_(std::move(scale)),
      totals_(std::move(totals)),
      ranking_(totals_.size()) {
  for (std::uint32_t i = 0; i < ranking_.size(); ++i) ranking_[i].member = i;
  const auto score = [&](const MemberPlace& place) { return totals_[place.member].score; };
  std::sort(ranking_.begin(), ranking_.end(), [&](const MemberPlace& a, const MemberPlace& b) {
    return score(a) != score(b) ? score(a) > score(b) : a.member < b.member;
  });
  for (std::uint32_t i = 0; i < ranking_.size(); ++i)
    ranking_[i].rank = i > 0 && score(ranking_[i]) == score(ranking_[i - 1]) ? ranking_[i - 1].rank : i + 1;
}

long double ClassTournament::total(std::size_t member) const {
  return static_cast<long double>(totals_[member].score) / static_cast<long double>(scale_.score_unit);
}

double ClassTournament::mean(std::size_t member) const {
  return static_cast<double>(total(member) / static_cast<long double>(settings_.criterion.total_weight()) /
                             static_cast<long double>(opponents()));
}

double ClassTournament::cooperation_rate(std::size_t member) const {
  return static_cast<double>(totals_[member].cooperations) / scale_.cooperation_unit /
         settings_.criterion.total_weight() / static_cast<double>(opponents());
}

std::uint64_t ClassTournament::signature() const {
  Signature signature;
  signature.add(members_.name());
  signature.add(to_text(settings_.payoffs));
  signature.add(settings_.criterion.to_string());
  signature.add(std::uint64_t{settings_.self_play ? 1U : 0U});
  for (const auto& totals : totals_)
    for (const std::int64_t number : {totals.score, totals.cooperations, totals.wins, totals.draws})
      signature.add(static_cast<std::uint64_t>(number));
  return signature.value();
}

}  // namespace folk
