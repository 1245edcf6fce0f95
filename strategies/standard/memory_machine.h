#pragma once
// The complete memory(X,Y) families of Mathieu & Delahaye (JASSS 20(4) 12, 2017): a move for every memory.

#include <folk/strategies/machine.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// max(X,Y) opening moves, then a move by the own last X and their last Y moves.
///
/// The table's index has the own last X moves (oldest first) above their last Y moves (oldest first), C = 0 and D = 1.
/// Its name, "mem12_ccCDCDDCDD", is X and Y, the openings in lower case and the table in upper case.
class MemoryMachine final : public Machine {
public:
  /// X and Y up to 9, X + Y from 1 to this.
  static constexpr unsigned longest_memory = 8;

  /// Moves as bits (true = D). Throws UsageError when the sizes do not fit X and Y.
  MemoryMachine(unsigned own_memory, unsigned their_memory, std::vector<bool> openings, std::vector<bool> table);

  /// Reads a name whose case, '_' and '-' do not matter; nothing when it is not of the form mem<digit><digit>...
  /// Throws UsageError when it is of the form but the number of moves is wrong.
  static std::optional<MemoryMachine> parse(std::string_view name);

  std::string name() const;

  State start() const override { return 0; }
  double cooperation(State state) const override;
  State next(State state, Move own, Move theirs) const override;

private:
  unsigned own_memory_;
  unsigned their_memory_;
  std::vector<bool> openings_;
  std::vector<bool> table_;
};

}  // namespace folk
