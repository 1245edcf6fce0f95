#include <folk/analysis/classes/class_incomes.h>
#include <folk/analysis/classes/class_tournament.h>
#include <folk/analysis/classes/joint_walk.h>
#include <folk/analysis/classes/own_copy.h>
#include <folk/analysis/crew/packing.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace folk {
namespace {

/// A living member and its place in the lists.
struct Living {
  std::uint32_t member;
  std::uint32_t place;
};

/// Genes for JointWalk: both players are whoever of a list has the genes chosen so far. What is chosen is a part of the
/// list, which is sorted by each gene that play asks for.
class Partition {
public:
  struct First {
    Living* begin;
    Living* end;
    std::uint32_t known;
  };
  using Second = First;

  struct Leaves {
    std::int64_t income = 0;
  };

  Partition(unsigned genes, std::span<const std::int64_t> numbers, double unit)
      : genes_(genes),
        numbers_(numbers),
        unit_(unit),
        incomes_(numbers.size(), 0) {}

  bool first(First& chosen, unsigned gene, unsigned move) const { return choose(chosen, gene, move); }
  bool second(Second& chosen, unsigned gene, unsigned move) const { return choose(chosen, gene, move); }

  void leaf(Leaves& leaves, const Second& second, const Lanes<double>& path) const {
    std::int64_t number = 0;
    for (const Living* living = second.begin; living != second.end; ++living) number += numbers_[living->place];
    leaves.income += number * static_cast<std::int64_t>(path[own_payoff] * unit_);
  }

  void add(const First& first, const Leaves& leaves) {
    if (leaves.income == 0) return;
    for (const Living* living = first.begin; living != first.end; ++living) incomes_[living->place] += leaves.income;
  }

  /// What those of a list have earned, in its order; it is forgotten.
  std::vector<std::int64_t> hand_over(std::span<const Living> list) {
    std::vector<std::int64_t> earned;
    earned.reserve(list.size());
    for (const Living& living : list) earned.push_back(std::exchange(incomes_[living.place], 0));
    return earned;
  }

  /// Those of a list whose genes under `mask` (of member numbers) are `value`.
  static void select(std::vector<Living>& selected, std::span<const Living> list, std::uint32_t mask,
                     std::uint32_t value) {
    selected.clear();
    for (const Living& living : list)
      if ((living.member & mask) == value) selected.push_back(living);
  }

private:
  bool choose(First& chosen, unsigned gene, unsigned move) const {
    const std::uint32_t bit = 1U << (genes_ - 1 - gene);
    const auto cooperates = [bit](const Living& living) { return (living.member & bit) == 0; };
    if ((chosen.known & bit) != 0) return cooperates(*chosen.begin) == (move == 0);
    chosen.known |= bit;
    // Asked for C first, the part is sorted by the gene, and stays so when asked for D.
    if (move == 0) {
      chosen.end = std::partition(chosen.begin, chosen.end, cooperates);
    } else {
      chosen.begin = std::partition_point(chosen.begin, chosen.end, cooperates);
    }
    return chosen.begin != chosen.end;
  }

  unsigned genes_;
  std::span<const std::int64_t> numbers_;
  double unit_;
  std::vector<std::int64_t> incomes_;  // by place
};

}  // namespace

ClassIncomes::ClassIncomes(const MemoryClass& members, const Payoffs& payoffs, const Criterion& criterion,
                           double individuals, unsigned threads, const Crew& crew)
    : members_(members),
      criterion_(criterion),
      threads_(std::max(1U, threads)),
      crew_(&crew),
      scale_(class_scale(members, payoffs, criterion, individuals)) {
  if (members.entries() > most_ranked_entries)
    throw UsageError(fmt::format("{} has {} members: populations take classes up to X + Y = 4", members.name(),
                                 members.size_text()));
  const double largest = criterion.total_weight() * scale_.payoffs.largest * static_cast<double>(scale_.common);
  if (scale_.exact && !(largest <= 0x1p53))
    throw UsageError(fmt::format("scores under {} are too large to count exactly", criterion.to_string()));
}

std::vector<std::int64_t> ClassIncomes::operator()(std::span<const std::uint32_t> members,
                                                   std::span<const std::int64_t> numbers,
                                                   const Progress& progress) const {
  const double unit = scale_.exact ? 1 : scale_.cooperation_unit;
  const unsigned openings = members_.openings();
  const unsigned entries = members_.entries();
  std::vector<Living> all(members.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = {members[i], i};
  const JointWalk<double> walk(members_, criterion_, scale_.payoffs.by_outcome, static_cast<double>(scale_.common));
  struct Worker {
    JointWalk<double> walk;
    Partition genes;
    std::vector<Living> first{};
    std::vector<Living> second{};
  };
  std::vector<Worker> workers(threads_, Worker{walk, Partition(members_.genes(), numbers, unit)});
  // A piece of work has both players' openings.
  const std::uint32_t mask = ((1U << openings) - 1) << entries;
  const auto first_of = [&](std::size_t piece) { return (static_cast<std::uint32_t>(piece) >> openings) << entries; };
  std::vector<std::vector<std::int64_t>> earned(std::size_t{1} << (2 * openings));  // by those of first_of
  crew_->run({[&] { return identity_of(members, numbers); }, earned.size(), threads_,
              [&](std::size_t piece, unsigned number) {
                Worker& worker = workers[number];
                const auto code = static_cast<std::uint32_t>(piece);
                Partition::select(worker.first, all, mask, first_of(piece));
                Partition::select(worker.second, all, mask, (code << entries) & mask);
                if (worker.first.empty() || worker.second.empty()) return;
                const auto part = [mask](std::vector<Living>& list) {
                  return Partition::First{list.data(), list.data() + list.size(), mask};
                };
                worker.walk.run(worker.genes, part(worker.first), part(worker.second));
                Partition::select(worker.first, all, mask, first_of(piece));  // in order again
                earned[piece] = worker.genes.hand_over(worker.first);
              },
              [&](std::size_t piece) {
                std::string bytes;
                pack(bytes, std::span<const std::int64_t>(earned[piece]));
                return bytes;
              },
              [&](std::size_t piece, std::string_view bytes) {
                Unpacker unpacker(bytes);
                earned[piece].resize(bytes.size() / sizeof(std::int64_t));
                unpacker.read(std::span(earned[piece]));
                unpacker.end();
              }},
             progress);
  std::vector<std::int64_t> incomes(members.size(), 0);
  std::vector<Living> list;
  for (std::size_t piece = 0; piece < earned.size(); ++piece) {
    if (earned[piece].empty()) continue;
    Partition::select(list, all, mask, first_of(piece));
    for (std::size_t i = 0; i < list.size(); ++i) incomes[list[i].place] += earned[piece].at(i);
  }
  return incomes;
}

std::uint64_t ClassIncomes::identity_of(std::span<const std::uint32_t> members,
                                        std::span<const std::int64_t> numbers) const {
  Signature signature;
  signature.add("incomes of a class");
  signature.add(members_.name());
  signature.add(criterion_.to_string());
  for (const double payoff : scale_.payoffs.by_outcome) signature.add(payoff);
  for (const std::uint32_t member : members) signature.add(std::uint64_t{member});
  for (const std::int64_t number : numbers) signature.add(static_cast<std::uint64_t>(number));
  return signature.value();
}

std::vector<std::int64_t> ClassIncomes::own_copies(std::span<const std::uint32_t> members) const {
  const double unit = scale_.exact ? 1 : scale_.cooperation_unit;
  JointWalk<double> walk(members_, criterion_, scale_.payoffs.by_outcome, static_cast<double>(scale_.common));
  std::vector<std::int64_t> scores;
  scores.reserve(members.size());
  for (const std::uint32_t member : members)
    scores.push_back(static_cast<std::int64_t>(own_copy(walk, members_, member)[own_payoff] * unit));
  return scores;
}

}  // namespace folk
