#pragma once
// Members of a class that no opponent can tell apart.

#include <folk/games/progress.h>
#include <folk/strategies/standard/memory_class.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// The behaviours of a class: what is left of its members when those that answer alike whatever the opponent does (own
/// moves being the machine's own) count once.
struct Behaviours {
  std::vector<std::uint32_t> of_member;  ///< the number of each member's behaviour
  std::vector<std::uint32_t> first;      ///< of each behaviour, its first member; ascending
  std::vector<std::uint32_t> members;    ///< of each behaviour, how many have it

  std::size_t size() const { return first.size(); }
};

/// Compares minimised automata. Throws UsageError for a class of more than 2^20 members, and Cancelled.
Behaviours behaviours_of(const MemoryClass& members, unsigned threads, const Progress& progress = nullptr);

}  // namespace folk
