#pragma once
// The automaton to show of a policy that was examined, and how it does against those it was not built from.

#include <folk/analysis/beliefs/extraction.h>
#include <folk/analysis/equilibria/examination.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <string>
#include <vector>

namespace folk {

/// An automaton that plays as the policy does.
struct ExtractedMachine {
  std::vector<Extraction> tried;
  std::size_t chosen = 0;   ///< the readable one of these (readable_machine), else the smallest
  Fidelity unseen;          ///< of that, against opponents it was not built from
  std::string unseen_name;  ///< who they were

  const Extraction& choice() const { return tried[chosen]; }
};

/// Extracts automata from the matches of an examination (extract_machines) and has the chosen one play `unseen` too,
/// whom a reader knows as `unseen_name`. The policy must be no machine and `examination` the answer to `question`.
/// Throws as extract_machines and record_beliefs do.
ExtractedMachine extract_machine(const ExaminationQuestion& question, const Examination& examination,
                                 const std::vector<Strategy>& unseen, std::string unseen_name,
                                 const Stages& stages = nullptr);

}  // namespace folk
