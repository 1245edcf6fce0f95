#pragma once
// How what was played agrees with the members of a complete class, however many there are.

#include <folk/analysis/judgement/recorded_play.h>
#include <folk/games/integer.h>
#include <folk/strategies/standard/memory_class.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace folk {

/// A round asks a member for one of its genes, whichever member it is. So what was played fixes the genes that it asked
/// for and leaves the others free: the members that agree are 2^(genes never asked), or none.
class ClassAgreement {
public:
  ClassAgreement(const MemoryClass& members, std::span<const RecordedMatch> matches, Seat seat);

  const MemoryClass& members() const { return members_; }

  /// Genes that some round asked for.
  unsigned asked() const;

  /// Members that would have made every move.
  Integer consistent() const { return fewest_slips() == 0 ? nearest() : Integer(0); }

  /// The least number of moves that must have been slips, if it was a member.
  std::uint64_t fewest_slips() const;

  /// How many members play it with so few.
  Integer nearest() const;

  /// These as one genotype in which '?' stands for either move: "mem12_c?CDC?DD?D".
  std::string nearest_text() const;

  /// ln P(the moves) when each slips with probability `slip` and all members are as likely as each other.
  double log_likelihood(double slip) const;

private:
  MemoryClass members_;
  std::vector<std::array<std::uint64_t, 2>> seen_;  // by gene, how often C and D was played where it was asked for
};

}  // namespace folk
