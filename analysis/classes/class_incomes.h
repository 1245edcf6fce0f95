#pragma once
// What the members of a class earn in a population of themselves, without playing the pairs one by one.

#include <folk/analysis/classes/class_scale.h>
#include <folk/analysis/crew/crew.h>
#include <folk/games/match_rules.h>
#include <folk/games/progress.h>
#include <folk/strategies/standard/memory_class.h>

#include <cstdint>
#include <span>
#include <vector>

namespace folk {

/// Incomes are whole numbers in units of ClassScale for `individuals` opponents. All members that answer alike on the
/// way to a leaf share the walk to it, so that an evolution gets faster as members die out.
class ClassIncomes {
public:
  /// Throws UsageError for a class of more than most_ranked_entries entries, and where incomes become too large to add
  /// up. `crew`, which shares the work, must outlive this.
  ClassIncomes(const MemoryClass& members, const Payoffs& payoffs, const Criterion& criterion, double individuals,
               unsigned threads = 1, const Crew& crew = one_process());

  /// sum_j n_j S_ij for each i of `members` (numbers in the class, each once): `numbers` holds n_j, of these members
  /// and no others. The result depends neither on the number of threads nor on the
  /// crew. Throws Cancelled, and what the crew throws.
  std::vector<std::int64_t> operator()(std::span<const std::uint32_t> members, std::span<const std::int64_t> numbers,
                                       const Progress& progress = nullptr) const;

  /// S_ii for each of `members`.
  std::vector<std::int64_t> own_copies(std::span<const std::uint32_t> members) const;

  const MemoryClass& members() const { return members_; }
  const ClassScale& scale() const { return scale_; }
  /// Of all rounds of a match.
  double total_weight() const { return criterion_.total_weight(); }

private:
  std::uint64_t identity_of(std::span<const std::uint32_t> members, std::span<const std::int64_t> numbers) const;

  MemoryClass members_;
  Criterion criterion_;
  unsigned threads_;
  const Crew* crew_;
  ClassScale scale_;
};

}  // namespace folk
