#pragma once
// Ecological competition of a complete class, its members fed without listing their pairs.

#include <folk/analysis/classes/behaviours.h>
#include <folk/analysis/classes/class_incomes.h>
#include <folk/analysis/evolution/dynamics.h>

namespace folk {

/// IntegerSelection with its default settings, n_i' = floor(N n_i f_i / sum_k n_k f_k) with f_i = sum_j n_j S_ij -
/// S_ii, for all members of a class (entrant i is member number i). Members that behave alike are fed as one.
class ClassSelection : public Dynamics {
public:
  /// `crew` feeds them together, and must outlive this. Throws UsageError on negative payoffs, more than
  /// most_individuals, and what ClassIncomes refuses; Cancelled.
  ClassSelection(const MemoryClass& members, const Payoffs& payoffs, const Criterion& criterion,
                 const Population& start, unsigned threads, const Progress& progress = nullptr,
                 const Crew& crew = one_process());

  void advance(Population& now, RandomStream&) const override;
  bool is_random() const override { return false; }
  bool stays_uniform() const override { return false; }
  std::string text() const override { return "ecological competition"; }

  /// The share of C in all moves when everybody plays everybody else.
  double cooperation(const Population& now) const;

  const MemoryClass& members() const { return incomes_.members(); }
  const Behaviours& behaviours() const { return behaviours_; }

private:
  /// The behaviours that are alive: each by a member that has it, how many individuals there are of it, and what each
  /// of them earns or does.
  struct Living {
    std::vector<std::uint32_t> behaviours;
    std::vector<std::uint32_t> members;
    std::vector<std::int64_t> numbers;
  };
  Living living_of(const Population& now) const;

  ClassIncomes incomes_;
  ClassIncomes cooperations_;
  Behaviours behaviours_;
  std::vector<std::int64_t> own_copies_;  // of each behaviour
  double total_ = 0;
};

}  // namespace folk
