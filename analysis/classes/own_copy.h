#pragma once
// The match of a member of a class with its own copy.

#include <folk/analysis/classes/joint_walk.h>

#include <cstdint>

namespace folk {

/// Genes for JointWalk: both players are member number `member`.
template <class Number>
struct OwnCopy {
  unsigned genes = 0;
  std::uint32_t member = 0;
  Lanes<Number> path{};

  struct First {};
  struct Second {};
  struct Leaves {};
  bool first(First&, unsigned gene, unsigned move) const { return ((member >> (genes - 1 - gene)) & 1U) == move; }
  bool second(Second&, unsigned gene, unsigned move) const { return ((member >> (genes - 1 - gene)) & 1U) == move; }
  void leaf(Leaves&, const Second&, const Lanes<Number>& values) { path = values; }
  void add(const First&, const Leaves&) const {}
};

/// What a member brings by lane when it meets its own copy.
template <class Number>
Lanes<Number> own_copy(JointWalk<Number>& walk, const MemoryClass& members, std::uint32_t member) {
  OwnCopy<Number> copy{members.genes(), member};
  walk.run(copy, {}, {});
  return copy.path;
}

}  // namespace folk
