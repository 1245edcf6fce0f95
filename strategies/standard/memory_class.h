#pragma once
// A complete class of Mathieu & Delahaye: every strategy of one memory, so that nobody's choice of opponents decides.

#include <folk/games/integer.h>
#include <folk/strategies/pool.h>
#include <folk/strategies/standard/memory_machine.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// The class memory(X,Y) (JASSS 20(4) 12, 2017): max(X,Y) opening moves, and a move for each of the 2^(X+Y) memories.
/// A member is its genes: the openings, then the table in MemoryMachine's order, true = D.
class MemoryClass {
public:
  /// X and Y up to 9, X + Y from 1 to MemoryMachine::longest_memory. Throws UsageError.
  MemoryClass(unsigned own_memory, unsigned their_memory);

  /// Rosters list the members of classes up to this size, to play them one by one.
  static constexpr std::uint64_t most_listed = Family::most_listed;

  /// Reads what stands between the brackets of "memory(X,Y)". Throws UsageError.
  static MemoryClass of_arguments(std::string_view arguments);

  /// Reads "memory(X,Y)", where case, blanks, '_' and '-' do not matter; nothing for any other form. Throws UsageError
  /// when X or Y is no such number.
  static std::optional<MemoryClass> parse(std::string_view text);

  std::string name() const;

  unsigned own_memory() const { return own_memory_; }
  unsigned their_memory() const { return their_memory_; }
  unsigned openings() const { return openings_; }
  unsigned entries() const { return 1U << (own_memory_ + their_memory_); }
  unsigned genes() const { return openings() + entries(); }

  /// How many members it has: 2^genes.
  Integer size() const;

  /// The same for the eye: "262144", and from 2^31 on "2^67".
  std::string size_text() const;

  /// The member of these genes, `genes()` of them.
  MemoryMachine member(const std::vector<bool>& genes) const;

  /// Member number `index` in the order of the genes, the first gene counting most.
  MemoryMachine member(Integer index) const;

  bool operator==(const MemoryClass&) const = default;

private:
  unsigned own_memory_;
  unsigned their_memory_;
  unsigned openings_;
};

}  // namespace folk
