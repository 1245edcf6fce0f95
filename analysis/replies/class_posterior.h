#pragma once
// What a match reveals about a member of a complete class.

#include <folk/analysis/replies/class_history.h>
#include <folk/games/move.h>
#include <folk/strategies/standard/memory_class.h>

#include <boost/container/small_vector.hpp>

#include <cstdint>

namespace folk {

/// Bayes' rule over all members of memory(X,Y), as likely as each other at first: then each gene is C or D with
/// probability 1/2 whatever the others are, and a round tells of one gene alone. So 2^genes members take no more than
/// their genes.
class ClassPosterior {
public:
  explicit ClassPosterior(const MemoryClass& members);

  /// P(the member plays C now) when each of its moves slips with probability `slip`, 0 to 0.5.
  double cooperation(double slip) const;

  /// What was really played; `theirs` is the member's move.
  void observe(Move own, Move theirs);

private:
  ClassHistory history_;
  boost::container::small_vector<std::int16_t, 20> lead_;  // of each gene, how much oftener C was seen than D
};

}  // namespace folk
