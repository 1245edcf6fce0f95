#pragma once
// The pictures of ipd-evolve.

#include <folk/tools/ipd_evolve/evolution_output.h>
#include <folk/tools/ipd_evolve/fixation_output.h>

#include <filesystem>
#include <optional>
#include <string>

namespace folk::tools {

/// svg, png, pdf or nothing, as --plot says, once it is clear that the programs that draw are there. Throws UsageError,
/// RendererMissing.
std::optional<std::string> chosen_picture(const po::variables_map& values);

/// populations, stack, cooperation where it is known, simplex for three strategies.
void draw_evolution(const std::filesystem::path& folder, const EvolutionReport& report, const std::string& extension);

/// fixation: a graph of few strategies, a heat map of more.
void draw_fixation(const std::filesystem::path& folder, const FixationReport& report, const std::string& extension);

/// Throws UsageError where draw_fixation would, before anything is computed.
void require_fixation_picture(std::size_t strategies);

}  // namespace folk::tools
