#pragma once
// The parts of sce-check's page.

#include <folk/tools/program/html.h>
#include <folk/tools/sce_check/output.h>
#include <folk/tools/sce_check/pictures.h>

#include <array>
#include <string>

namespace folk::tools {

/// A row a notion: the word, the margin, what shows it; with `worst` also the opponent that is worst.
Html verdict_table(const Certificates& verdicts, const std::array<std::string, all_notions.size()>* worst,
                   bool believes);

/// A row an opponent, with the columns that something is known for; names lead to their sections.
Html opponent_table(const SceReport& report);

/// A row an opponent, a column a notion: from which round on each holds for good. The report must have asked for it.
Html settlement_section(const SceReport& report);

/// Where the section of an opponent begins.
std::string opponent_id(std::size_t opponent);

/// All that was found about one opponent.
Html opponent_section(const SceQuestion& question, const SceReport& report, std::size_t opponent,
                      const Pictures& pictures);

/// The automaton that plays as the policy does, how faithfully, and what other sizes cost.
Html extracted_section(const SceQuestion& question, const ExtractedMachine& extracted, const Pictures& pictures);

/// How a set of beliefs scored: "belief" may be of one opponent or of all.
Html belief_list(const BeliefConsistency& belief, const std::optional<sct::BeliefEffect>& effect);

}  // namespace folk::tools
