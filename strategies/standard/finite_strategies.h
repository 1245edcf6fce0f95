#pragma once
// The finite strategies, as data: to add one, add a line to finite_strategies.cpp or library_strategies.cpp and its
// transcript to tests/data/transcripts.csv.

#include <string_view>
#include <vector>

namespace folk {

/// A finite machine by name. `machine` is a genotype (mem12_ccCCCDCDDD), a word (per_ccd), or the text form of
/// strategies/machine_text.h on one line: state, move, successors on their C and their D (or on CC CD DC DD).
struct FiniteStrategy {
  std::string_view name;
  std::vector<std::string_view> aliases;
  std::string_view machine;
  std::string_view behaviour;
  std::string_view reference;
  std::string_view elsewhere{};  ///< who means another strategy by the name, and what that one is called here
};

/// The classics and what is related to them.
const std::vector<FiniteStrategy>& finite_strategies();

/// Memory-one strategies with names; `machine` is a mem1(...), zero-determinant ones as for T=5,R=3,P=1,S=0.
const std::vector<FiniteStrategy>& memory_one_strategies();

/// Those of Axelrod's tournaments and of Axelrod-Python.
const std::vector<FiniteStrategy>& library_strategies();

}  // namespace folk
