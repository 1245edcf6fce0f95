#pragma once
// What a match reveals about a member of a complete class.

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
  std::size_t gene() const;

  unsigned own_memory_;    // of the member
  unsigned their_memory_;  // of its opponent's moves
  unsigned openings_;
  std::uint32_t rounds_ = 0;   // past ones, as far as openings_
  std::uint32_t members_ = 0;  // its last moves, the last one lowest, D = 1
  std::uint32_t others_ = 0;
  boost::container::small_vector<std::int16_t, 20> lead_;  // of each gene, how much oftener C was seen than D
};

}  // namespace folk
