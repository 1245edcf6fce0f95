#pragma once
// The answer of `ipd-strategies diff`, as text, JSON and CSV.

#include <folk/strategies/equivalence.h>

#include <nlohmann/json.hpp>
#include <string>

namespace folk::tools {

/// Which strategies were compared and what came out.
struct Difference {
  std::string first;
  std::string second;
  Sense sense = Sense::own_moves_its_own;
  Comparison found;
};

/// "any own moves" or "own moves its own", and the same as a word of JSON and CSV.
const char* sense_text(Sense sense);
const char* sense_key(Sense sense);

/// What comes out for two machines, and whether they are one strategy by name: of an infinite one walking would never
/// end, and there is nothing to prove.
Comparison compared(const Machine& first, const Machine& second, bool same_name, Sense sense, std::size_t most_pairs);

/// One line: "different: after their moves D (own C): spiteful plays D, tf2t plays C".
std::string difference_text(const Difference& difference);

/// Result, sense, pairs, depth; play and answers (P(C) of both) when they differ, else null.
nlohmann::ordered_json difference_json(const Difference& difference);

/// A header and one line.
std::string difference_csv(const Difference& difference);

}  // namespace folk::tools
